// The text of an InputError.
#pragma once

#include <string>

#include "solver/support/diagnostics.h"

namespace twinarm::testing {

// Of the error that `make` throws; empty if it throws none.
template <class Make>
std::string problem_of(Make&& make) {
  try {
    make();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace twinarm::testing
