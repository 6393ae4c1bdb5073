// Parses files of strangers in child processes with limits (sandboxed_process.h), since libraries
// for file formats may crash, not terminate or be taken over. What a child returns is data of our
// own formats, read with bounds.
#pragma once

#include <string>

#include "collision/sandbox/sandboxed_process.h"
#include "solver/support/state_archive.h"

namespace twinarm {

// From now on, in this process, parse() uses a child: for servers.
void isolate_parsers(bool on = true);
bool parsers_are_isolated();

// What `work` packs in a child. Throws InputError, also of the parser, or "parser.failed" if the
// child fails or exceeds its limits.
std::string parsed_in_child(const std::string& file, const std::string& bytes, ChildWork work);
// What such work does: reads the order, and packs the result or the faults.
std::string answer_of_parser(const std::string& order,
                             std::string (*parsed)(const std::string& file,
                                                   const std::string& bytes));
[[noreturn]] void refuse_parsed(const std::string& file, const std::string& problem);

// What `read` returns for this file, or for these bytes of it; if parsers are isolated, from a
// child, transferred by serialize(StateArchive&, Result&). Throws InputError.
template <auto read>
auto parse(const std::string& file, const std::string& bytes = "") {
  if (!parsers_are_isolated()) return read(file, bytes);
  auto result = unpacked<decltype(read(file, bytes))>(
      parsed_in_child(file, bytes, [](const std::string& order) {
        return answer_of_parser(order,
                                [](const std::string& its_file, const std::string& its_bytes) {
                                  return packed(read(its_file, its_bytes));
                                });
      }));
  if (!result) refuse_parsed(file, "fails");
  return std::move(*result);
}

}  // namespace twinarm
