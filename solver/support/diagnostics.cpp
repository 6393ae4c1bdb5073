#include "solver/support/diagnostics.h"

#include <algorithm>
#include <cmath>

#include "solver/support/number_text.h"

namespace twinarm {
namespace {

// Cuts texts longer than 1000 bytes, not within a UTF-8 character.
void truncate(Diagnostic& fault) {
  constexpr std::size_t kMaxBytes = 1000;
  for (std::string* text : {&fault.where, &fault.problem, &fault.fix}) {
    if (text->size() <= kMaxBytes) continue;
    std::size_t end = kMaxBytes;
    while (end > 0 && (static_cast<unsigned char>((*text)[end]) & 0xc0) == 0x80) --end;
    text->resize(end);
    *text += "...";
  }
}

std::string truncated_lines(std::vector<Diagnostic>& faults) {
  std::string text;
  for (Diagnostic& fault : faults) {
    truncate(fault);
    text += (text.empty() ? "" : "\n") + to_string(fault);
  }
  return text;
}

}  // namespace

std::string to_string(const Diagnostic& fault) {
  std::string text;
  if (!fault.file.empty()) {
    text += fault.file;
    if (fault.line > 0) text += ":" + std::to_string(fault.line);
    text += ": ";
  }
  if (!fault.where.empty()) text += fault.where + ": ";
  text += fault.problem;
  if (!fault.fix.empty()) text += "; " + fault.fix;
  const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
  std::ranges::replace_if(text, is_control, '?');  // one line; NUL ends it, ESC leads a terminal
  return text;
}

bool is_of_option(const Diagnostic& fault, std::string_view option) {
  return fault.where.starts_with("--") && fault.where.substr(2) == option;
}

void add_diagnostic(std::vector<Diagnostic>& faults, Diagnostic fault) {
  truncate(fault);
  if (faults.size() < kMaxFaults)
    faults.push_back(std::move(fault));
  else if (faults.size() == kMaxFaults)
    faults.push_back({std::move(fault.file), 0, "",
                      "has more than " + std::to_string(kMaxFaults) + " errors",
                      "fix the errors that are listed and run again", "faults.too-many"});
}

InputError::InputError(std::vector<Diagnostic> faults)
    : std::runtime_error(truncated_lines(faults)), faults_(std::move(faults)) {}
InputError::~InputError() = default;

void check_step_size(double h) {
  if (h > 0 && std::isfinite(h)) return;
  throw InputError("step size", "is " + number_text(h) + " s, must be positive and finite",
                   "give a step size in seconds, such as 0.001", "run.step");
}
std::size_t stored_steps(double duration, double h) {
  const double steps = std::ceil(duration / h);
  if (steps <= 1e7) return static_cast<std::size_t>(steps);
  throw InputError("step size",
                   "is " + short_number_text(h) + " s; of " + short_number_text(duration) +
                       " s at most 1e7 steps can be stored",
                   "give a longer step or a shorter time", "run.too-many-steps");
}

}  // namespace twinarm
