#include "solver/fault.h"

#include <utility>

namespace twinarm {
namespace {

std::string line_by_line(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) text += (text.empty() ? "" : "\n") + to_string(fault);
  return text;
}

}  // namespace

std::string to_string(const Fault& fault) {
  std::string text;
  if (!fault.file.empty()) {
    text += fault.file;
    if (fault.line > 0) text += ":" + std::to_string(fault.line);
    text += ": ";
  }
  if (!fault.where.empty()) text += fault.where + ": ";
  text += fault.rule;
  if (!fault.remedy.empty()) text += "; " + fault.remedy;
  return text;
}

InputError::InputError(std::vector<Fault> faults)
    : std::runtime_error(line_by_line(faults)), faults_(std::move(faults)) {}
InputError::~InputError() = default;

void FaultList::add(Fault fault) {
  faults_.push_back(std::move(fault));
}
void FaultList::add(const std::vector<Fault>& more) {
  faults_.insert(faults_.end(), more.begin(), more.end());
}
void FaultList::check() const {
  if (!faults_.empty()) throw InputError(faults_);
}

}  // namespace twinarm
