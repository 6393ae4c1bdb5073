// A process that forks the children of run_limited() for a program with threads.
#pragma once

#include <string>

#include "collision/sandbox/sandboxed_process.h"

namespace twinarm {

// While it exists, the children of run_limited() are copies of this process as it is when the
// server is constructed, which must be before the first thread.
class ForkServer {
 public:
  ForkServer();  // throws std::system_error
  ~ForkServer();
  ForkServer(const ForkServer&) = delete;
  ForkServer& operator=(const ForkServer&) = delete;

 private:
  int process_;
};

bool has_fork_server();
// As run_limited(), in a child of the server.
ChildResult run_by_server(ChildWork work, const std::string& argument, const ChildLimits& limits);

}  // namespace twinarm
