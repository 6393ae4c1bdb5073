// Standard streams that may be closed, full, or of a terminal that is gone.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace twinarm {

// First of all: takes the place of those that are closed. Else the next file that is opened would
// get the number of, say, stdout, and what is printed would go into it.
void fill_closed_streams();

// Throws InputError where something that was printed on stdout did not get out.
void check_stdout();

// Words for people, on stderr. That nobody is there to read them is no fault: fmt::print would
// throw.
template <class... Values>
void say(fmt::format_string<Values...> words, Values&&... values) {
  std::fputs(fmt::format(words, std::forward<Values>(values)...).c_str(), stderr);
}

}  // namespace twinarm
