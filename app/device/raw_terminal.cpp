#include "app/device/raw_terminal.h"

#include <signal.h>
#include <termios.h>

#include <array>

namespace twinarm {
namespace {

// What a signal handler can get at.
constexpr std::array<int, 4> kEndings{SIGINT, SIGTERM, SIGHUP, SIGQUIT};
volatile sig_atomic_t raw_fd = -1;
termios cooked;
struct sigaction handlers_before[kEndings.size()];

// Makes the terminal what it was, then does what would have been done without us.
void restore_and_go_on(int signal_number) {
  if (raw_fd >= 0) tcsetattr(raw_fd, TCSANOW, &cooked);  // allowed in a handler
  for (std::size_t n = 0; n < kEndings.size(); ++n) {
    if (kEndings[n] != signal_number) continue;
    const auto before = handlers_before[n].sa_handler;
    if (before == SIG_DFL) {
      signal(signal_number, SIG_DFL);
      raise(signal_number);
    } else if (before != SIG_IGN) {
      before(signal_number);
    }
  }
}

}  // namespace

RawTerminal::RawTerminal(int fd) {
  if (raw_fd >= 0 || tcgetattr(fd, &cooked) != 0) return;
  is_terminal_ = true;
  raw_fd = fd;
  struct sigaction ours {};
  ours.sa_handler = restore_and_go_on;
  for (std::size_t n = 0; n < kEndings.size(); ++n)
    sigaction(kEndings[n], &ours, &handlers_before[n]);
  termios raw = cooked;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // Ctrl-C stays a signal
  raw.c_cc[VMIN] = 0;
  raw.c_cc[VTIME] = 0;
  tcsetattr(fd, TCSANOW, &raw);
}

RawTerminal::~RawTerminal() {
  if (!is_terminal_) return;
  tcsetattr(raw_fd, TCSANOW, &cooked);
  for (std::size_t n = 0; n < kEndings.size(); ++n) {
    struct sigaction now {};
    sigaction(kEndings[n], nullptr, &now);
    if (now.sa_handler == restore_and_go_on) sigaction(kEndings[n], &handlers_before[n], nullptr);
  }
  raw_fd = -1;
}

}  // namespace twinarm
