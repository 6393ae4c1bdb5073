// The sockets between a process and its children, and what a child does with its other files.
// Internal to sandboxed_process.cpp and fork_server.cpp.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace twinarm {

struct SocketPair {
  int mine, theirs;
};
SocketPair make_sockets();  // throws std::system_error

[[noreturn]] void throw_errno(const char* what);  // as std::system_error

using SendSome = ssize_t (*)(int socket, const void* bytes, std::size_t count);
ssize_t send_without_signal(int socket, const void* bytes, std::size_t count);

// Both until the other end is closed. False if it was closed too early.
bool send_all(int socket, std::string_view bytes, SendSome send_some = send_without_signal);
// Empty on timeout, if the other end sends too much, and when `is_interrupted`, which is asked
// several times a second.
std::optional<std::string> receive_all(int socket, std::chrono::seconds timeout,
                                       bool (*is_interrupted)() = nullptr);

// Suppresses messages of libraries; the parent reports the error. Not under sanitizers.
void discard_output();
// Closes what the parent has open but the standard streams and `socket`; returns its new number.
int close_others(int socket);

}  // namespace twinarm
