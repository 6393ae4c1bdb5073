#include "solver/support/diagnostics.h"

#include <cmath>
#include <utility>

#include "solver/support/number_text.h"

namespace twinarm {
namespace {

std::string line_by_line(const std::vector<Diagnostic>& faults) {
  std::string text;
  for (const Diagnostic& fault : faults) text += (text.empty() ? "" : "\n") + to_string(fault);
  return text;
}

// Not within a letter of UTF-8.
void shorten(std::string& text) {
  constexpr std::size_t kLongest = 1000;
  if (text.size() <= kLongest) return;
  std::size_t end = kLongest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  text.resize(end);
  text += "...";
}

void shorten(Diagnostic& fault) {
  for (std::string* text : {&fault.where, &fault.problem, &fault.fix}) shorten(*text);
}

std::vector<Diagnostic>& shortened(std::vector<Diagnostic>& faults) {
  for (Diagnostic& fault : faults) shorten(fault);
  return faults;
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
  return text;
}

bool is_of_option(const Diagnostic& fault, std::string_view option) {
  return fault.where.starts_with("--") && fault.where.substr(2) == option;
}

void add_diagnostic(std::vector<Diagnostic>& faults, Diagnostic fault) {
  shorten(fault);
  if (faults.size() < kMaxFaults)
    faults.push_back(std::move(fault));
  else if (faults.size() == kMaxFaults)
    faults.push_back({std::move(fault.file), 0, "",
                      "has more than " + std::to_string(kMaxFaults) + " faults",
                      "mend the others that are told, and try again", "faults.too-many"});
}

InputError::InputError(std::vector<Diagnostic> faults)
    : std::runtime_error(line_by_line(shortened(faults))), faults_(std::move(faults)) {}
InputError::~InputError() = default;

void DiagnosticList::add(Diagnostic fault) {
  add_diagnostic(faults_, std::move(fault));
}
void DiagnosticList::add(const std::vector<Diagnostic>& more) {
  for (const Diagnostic& fault : more) add(fault);
}
void DiagnosticList::check() const {
  if (!faults_.empty()) throw InputError(faults_);
}

void check_step_size(double h) {
  if (h > 0 && std::isfinite(h)) return;
  throw InputError({{"", 0, "step size", "is " + number_text(h) + " s, must be positive and finite",
                     "give a step size in seconds, such as 0.001", "run.step"}});
}

}  // namespace twinarm
