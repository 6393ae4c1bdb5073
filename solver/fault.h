// What is wrong with an input, told so that it can be mended: where, which rule, which remedy.
//
// A reader (URDF, mesh, trace, scene, command line) collects every fault it finds and throws them
// all at once as one InputError. The program prints them and ends with exit code 2.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace twinarm {

struct Fault {
  std::string file;    // empty where no file is at fault
  int line = 0;        // 1-based; 0 where unknown
  std::string where;   // the element, body, joint or option, by its name in the user's file
  std::string rule;    // what does not hold, with the value that was found
  std::string remedy;  // what to do about it
};

// "robot.urdf:12: link 'arm1': mass is -3 kg, must be positive; give <mass value=...>"
inline std::string to_string(const Fault& fault) {
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

// Bad input, with all its faults. what() has one line per fault.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Fault> faults)
      : std::runtime_error(join(faults)), faults_(std::move(faults)) {}
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  static std::string join(const std::vector<Fault>& faults) {
    std::string text;
    for (const Fault& fault : faults) text += (text.empty() ? "" : "\n") + to_string(fault);
    return text;
  }
  std::vector<Fault> faults_;
};

// Collects faults; check() throws them together. One per reader.
class FaultList {
 public:
  void add(Fault fault) { faults_.push_back(std::move(fault)); }
  void add(const std::vector<Fault>& more) {
    faults_.insert(faults_.end(), more.begin(), more.end());
  }
  bool empty() const { return faults_.empty(); }
  void check() const {
    if (!faults_.empty()) throw InputError(faults_);
  }

 private:
  std::vector<Fault> faults_;
};

}  // namespace twinarm
