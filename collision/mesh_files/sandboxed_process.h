// Work that may crash or never end, done in a child process with limits of its own.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace twinarm {

struct ChildLimits {
  unsigned cpu_seconds = 20;
  unsigned wall_seconds = 60;  // for work that waits for what never comes
  // Of address space, beside what the program has already; not under sanitizers.
  std::size_t bytes = std::size_t{1} << 30;
};
struct ChildResult {
  std::string bytes;  // what the work returned
  std::string fault;  // why there is nothing; empty where all went well
};

// Calls `work` in a child process, which ends with it: whatever it breaks or leaks is gone. What it
// throws is a fault, without its text. Costs a millisecond and a copy of the bytes. Throws
// std::system_error where the system has no process or pipe left.
ChildResult run_limited(const std::function<std::string()>& work, const ChildLimits& limits = {});

}  // namespace twinarm
