// Python's signal handlers within long calls, with or without the global interpreter lock.
#pragma once

namespace twinarm::python {

// True once a handler has thrown, as that of Ctrl-C does. Looks every 0.1 s, as another thread may
// hold the lock for a while.
bool is_signalled();
// Throws that exception.
void check_signals();

}  // namespace twinarm::python
