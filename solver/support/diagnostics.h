// What is wrong with an input, told so that it can be mended: where, which rule, which remedy.
//
// A reader (URDF, mesh, trace, scene, command line) collects every fault it finds and throws them
// all at once as one InputError. The program prints them and ends with exit code 2.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace twinarm {

struct Diagnostic {
  std::string file;     // empty where no file is at fault
  int line = 0;         // 1-based; 0 where unknown
  std::string where;    // the element, body or joint, by its name in the user's file; or "--option"
  std::string problem;  // what does not hold, with the value that was found
  std::string fix;      // what to do about it
  // What kind of fault it is: GROUP.NAME, a literal that stays when the texts above change.
  // Programs and tests compare this and no text.
  std::string_view code;
};

bool is_of_option(const Diagnostic& fault, std::string_view option);  // "duration"

// "robot.urdf:12: link 'arm1': mass is -3 kg, must be positive; give <mass value=...>"
std::string to_string(const Diagnostic& fault);

// Of a hostile file there could be millions: so many are kept, and that there are more. A text in
// one is cut after 1000 bytes, here and by InputError.
inline constexpr std::size_t kMaxFaults = 200;
void add_diagnostic(std::vector<Diagnostic>& faults, Diagnostic fault);

// Bad input, with all its faults. what() has one line per fault.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Diagnostic> faults);
  ~InputError() override;
  const std::vector<Diagnostic>& faults() const { return faults_; }

 private:
  std::vector<Diagnostic> faults_;
};

// Collects faults; check() throws them together. One per reader.
class DiagnosticList {
 public:
  void add(Diagnostic fault);
  // Of no file.
  void add(std::string where, std::string problem, std::string fix, std::string_view code) {
    add(Diagnostic{"", 0, std::move(where), std::move(problem), std::move(fix), code});
  }
  void add(const std::vector<Diagnostic>& more);
  bool empty() const { return faults_.empty(); }
  bool is_full() const { return faults_.size() > kMaxFaults; }
  const std::vector<Diagnostic>& faults() const { return faults_; }
  void check() const;

 private:
  std::vector<Diagnostic> faults_;
};

// The one check of a step size, for all functions that take one from a caller: throws InputError
// unless h [s] is positive and finite.
void check_step_size(double h);

}  // namespace twinarm
