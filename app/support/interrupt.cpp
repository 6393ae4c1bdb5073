#include "app/support/interrupt.h"

#include <csignal>

namespace twinarm {
namespace {
volatile std::sig_atomic_t interrupted = 0;
}

void catch_interrupts() {
  const auto note = [](int) { interrupted = 1; };
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
  if (std::signal(SIGHUP, note) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // as nohup wants it
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file beyond the user's limit is told by write(), as a full disk is
}

bool is_interrupted() {
  return interrupted != 0;
}

void forget_interrupt() {
  interrupted = 0;
}

void check_interrupt() {
  if (interrupted) throw Interrupted();
}

}  // namespace twinarm
