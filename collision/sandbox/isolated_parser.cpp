#include "collision/sandbox/isolated_parser.h"

#include <atomic>
#include <mutex>
#include <set>
#include <utility>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

std::atomic<bool> isolated{false};

// The code lives as long as the program, as a literal does. Not more than a taken-over child needs
// to name all there are.
std::string_view kept_code(const std::string& code) {
  static std::mutex mutex;
  static std::set<std::string> codes;
  const std::lock_guard lock(mutex);
  constexpr std::size_t kMaxCodes = 1000, kMaxLength = 64;
  if (codes.size() >= kMaxCodes || code.size() > kMaxLength) return "parser.failed";
  return *codes.insert(code).first;
}

// The faults of an InputError, none if the parser succeeded.
void serialize(StateArchive& archive, std::vector<Diagnostic>& faults) {
  archive.resize(faults, 1);
  for (Diagnostic& fault : faults) {
    std::string code(fault.code);
    archive.visit(fault.file, fault.line, fault.where, fault.problem, fault.fix, code);
    if (archive.reads()) fault.code = kept_code(code);
  }
}

}  // namespace

void isolate_parsers(bool on) {
  isolated = on;
}
bool parsers_are_isolated() {
  return isolated;
}

void refuse_parsed(const std::string& file, const std::string& problem) {
  throw InputError({{file, 0, "", "the reader of this file " + problem,
                     "give a smaller file, or repair it", "parser.failed"}});
}

std::string answer_of_parser(const std::string& order,
                             std::string (*parsed)(const std::string& file,
                                                   const std::string& bytes)) {
  StateArchive received(order);
  std::string file, bytes, result;
  received.visit(file, bytes);
  std::vector<Diagnostic> faults;
  try {
    result = parsed(file, bytes);
  } catch (const InputError& error) {
    faults = error.faults();
  }
  StateArchive archive;
  serialize(archive, faults);
  archive.visit(result);
  return archive.bytes();
}

std::string parsed_in_child(const std::string& file, const std::string& bytes, ChildWork work) {
  std::string name = file, content = bytes;
  StateArchive order;
  order.visit(name, content);
  ChildResult child = run_limited(work, order.bytes(), {.cpu_seconds = 10, .wall_seconds = 30});
  if (!child.fault.empty()) refuse_parsed(file, child.fault);
  StateArchive archive(std::move(child.bytes));
  std::vector<Diagnostic> faults;
  std::string result;
  try {
    serialize(archive, faults);
    archive.visit(result);
  } catch (const std::runtime_error&) {  // truncated
    refuse_parsed(file, "fails");
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  return result;
}

}  // namespace twinarm
