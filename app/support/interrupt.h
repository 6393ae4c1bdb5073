// Ctrl-C, or a terminal that is closed: asked for once, noticed at the next safe point, so that no
// half file stays behind.
#pragma once

#include <exception>

namespace twinarm {

struct Interrupted : std::exception {
  const char* what() const noexcept override { return "interrupted"; }
};

void catch_interrupts();  // from now on SIGINT, SIGTERM and SIGHUP only set a flag
bool is_interrupted();    // whether it is set
void forget_interrupt();  // it has been obeyed: what is still to be done has a Ctrl-C of its own
void check_interrupt();   // throws Interrupted once the flag is set

}  // namespace twinarm
