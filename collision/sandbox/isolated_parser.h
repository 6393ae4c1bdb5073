// Parses files of strangers in child processes with limits (sandboxed_process.h), since libraries
// for file formats may crash, not terminate or be taken over. What a child returns is data of our
// own formats, read with bounds.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "solver/support/state_archive.h"

namespace twinarm {

// From now on, in this process, parse() uses a child: for servers.
void isolate_parsers(bool on = true);
bool parsers_are_isolated();

// In a child: the bytes of `parse`. Throws InputError, also those of `parse`, or "parser.failed" if
// the child fails or exceeds its limits.
std::string parsed_in_child(const std::filesystem::path& file,
                            const std::function<std::string()>& parse);
[[noreturn]] void refuse_parsed(const std::filesystem::path& file, const std::string& problem);

// What `read` returns; if parsers are isolated, from a child, transferred by
// serialize(StateArchive&, Result&). Throws InputError.
template <class Result>
Result parse(const std::filesystem::path& file, const std::function<Result()>& read) {
  if (!parsers_are_isolated()) return read();
  StateArchive archive(parsed_in_child(file, [&] {
    StateArchive packed;
    Result result = read();
    serialize(packed, result);
    return packed.bytes();
  }));
  try {
    Result result;
    serialize(archive, result);
    if (archive.at_end()) return result;
  } catch (const std::runtime_error&) {  // truncated
  }
  refuse_parsed(file, "fails");
}

}  // namespace twinarm
