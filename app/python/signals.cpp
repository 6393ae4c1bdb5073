#include "app/python/signals.h"

#include <pybind11/pybind11.h>

#include <chrono>

namespace twinarm::python {
namespace {

thread_local bool has_thrown = false;

}  // namespace

bool is_signalled() {
  using Clock = std::chrono::steady_clock;
  thread_local Clock::time_point next;
  if (has_thrown || Clock::now() < next) return has_thrown;
  const pybind11::gil_scoped_acquire lock;
  has_thrown = PyErr_CheckSignals() != 0;
  next = Clock::now() + std::chrono::milliseconds(100);
  return has_thrown;
}

void check_signals() {
  if (!is_signalled()) return;
  has_thrown = false;
  const pybind11::gil_scoped_acquire lock;
  throw pybind11::error_already_set();
}

}  // namespace twinarm::python
