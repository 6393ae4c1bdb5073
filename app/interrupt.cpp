#include "app/interrupt.h"

#include <csignal>

namespace twinarm {
namespace {
volatile std::sig_atomic_t interrupted = 0;
}

void catch_interrupts() {
  const auto note = [](int) { interrupted = 1; };
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
}

bool is_interrupted() {
  return interrupted != 0;
}

void check_interrupt() {
  if (interrupted) throw Interrupted();
}

}  // namespace twinarm
