#include "app/lab/app/audit_log.h"

#include <fmt/chrono.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>

namespace twinarm {
namespace {

// Printable ASCII; other bytes as \xNN: nothing controls a terminal or begins a line.
std::string printable(const std::string& text) {
  constexpr std::size_t kMax = 300;  // [bytes]
  std::string safe;
  for (const unsigned char c : text.substr(0, kMax))
    safe +=
        c >= ' ' && c < 0x7f ? std::string(1, static_cast<char>(c)) : fmt::format("\\x{:02x}", c);
  return text.size() > kMax ? safe + fmt::format(".. ({} bytes)", text.size()) : safe;
}

}  // namespace

std::string AuditLog::line(const std::string& client, const std::string& change, bool is_movement,
                           Time now) {
  std::string text = client + ": " + printable(change);
  if (is_movement) {
    if (text == movement_ && now - moved_at_ < std::chrono::minutes(1)) return "";
    movement_ = text;
    moved_at_ = now;
  }
  if (!lines_.passes(now, 1, 20)) return ++left_out_, "";
  if (left_out_ > 0) text += fmt::format(" ({} before it left out)", left_out_);
  left_out_ = 0;
  return fmt::format("{:%FT%TZ} {}\n", fmt::gmtime(std::time(nullptr)), text);
}

void AuditLog::add(const std::string& client, const std::string& change, bool is_movement) {
  const std::string text = line(client, change, is_movement, std::chrono::steady_clock::now());
  pollfd ready{STDERR_FILENO, POLLOUT, 0};
  if (::poll(&ready, 1, 0) == 1 && (ready.revents & POLLOUT) != 0) std::fputs(text.c_str(), stderr);
}

}  // namespace twinarm
