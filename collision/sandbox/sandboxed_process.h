// Runs work that may crash, not terminate or be taken over in a child process with limits: of time
// and memory, without the parent's files, and unable to change anything (system_call_filter.h).
//
// The child is a copy of the process at that moment, without its other threads. Locks that these
// held stay locked, but for glibc's own (heap, stdio, loader): `work` may take no others of theirs.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace twinarm {

struct ChildLimits {
  unsigned cpu_seconds = 20;
  unsigned wall_seconds = 60;
  // Additional address space; not limited under sanitizers.
  std::size_t bytes = std::size_t{1} << 30;
};
struct ChildResult {
  std::string bytes;  // return value of the work
  std::string fault;  // error; empty on success
};

// Calls `work` in a child process. An exception of `work` is an error without its text. Costs a
// millisecond and a copy of the bytes. In such a child it calls `work` directly. Throws
// std::system_error if no process or pipe can be created.
ChildResult run_limited(const std::function<std::string()>& work, const ChildLimits& limits = {});

}  // namespace twinarm
