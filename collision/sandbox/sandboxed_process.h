// Runs work that may crash, not terminate or be taken over in a child process with limits: of time
// and memory, without the parent's files, and unable to change anything (system_call_filter.h).
//
// The child is a copy of the process, without its other threads; locks that these held would stay
// locked in it. So a program with threads starts a ForkServer (fork_server.h)
// before them.
#pragma once

#include <cstddef>
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
using ChildWork = std::string (*)(const std::string& argument);

// Calls `work` in a child process. An exception of `work` is an error without its text. Costs a
// millisecond and a copy of the bytes. In such a child it calls `work` directly. Throws
// std::system_error if no process or socket can be created.
ChildResult run_limited(ChildWork work, const std::string& argument,
                        const ChildLimits& limits = {});

// Asked while a child works, by default never: true ends the child, with the fault "was
// interrupted".
void end_children_when(bool (*is_interrupted)());

// The same, always in a child of this process.
ChildResult run_in_fork(ChildWork work, const std::string& argument, const ChildLimits& limits);

}  // namespace twinarm
