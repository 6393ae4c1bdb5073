// Errors of an input: location, problem, fix.
//
// A reader (URDF, mesh, trace, scene, command line) collects all errors and throws them as one
// InputError. The program prints them and exits with code 2.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace twinarm {

struct Diagnostic {
  std::string file;     // empty: not about a file
  int line = 0;         // 1-based; 0: unknown
  std::string where;    // element, body or joint, by its name in the user's file; or "--option"
  std::string problem;  // what is wrong, with the value found
  std::string fix;      // what to do
  // GROUP.NAME, a string literal. Programs and tests compare the code, not the texts.
  std::string_view code;
};

bool is_of_option(const Diagnostic& fault, std::string_view option);  // "duration"

// "robot.urdf:12: link 'arm1': mass is -3 kg, must be positive; give <mass value=...>"
std::string to_string(const Diagnostic& fault);

// Keeps at most kMaxFaults and one note that there are more. Texts are cut after 1000 bytes, here
// and by InputError.
inline constexpr std::size_t kMaxFaults = 200;
void add_diagnostic(std::vector<Diagnostic>& faults, Diagnostic fault);

// what() has one line per error.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Diagnostic> faults);
  // Not about a file.
  InputError(std::string where, std::string problem, std::string fix, std::string_view code)
      : InputError({{"", 0, std::move(where), std::move(problem), std::move(fix), code}}) {}
  ~InputError() override;
  const std::vector<Diagnostic>& faults() const { return faults_; }
  // The same errors after change(Diagnostic&) of each.
  template <class F>
  InputError changed(F&& change) const {
    std::vector<Diagnostic> faults = faults_;
    for (Diagnostic& fault : faults) change(fault);
    return InputError(std::move(faults));
  }

 private:
  std::vector<Diagnostic> faults_;
};

// Collects errors; check() throws them together.
class DiagnosticList {
 public:
  void add(Diagnostic fault) { add_diagnostic(faults_, std::move(fault)); }
  // Not about a file.
  void add(std::string where, std::string problem, std::string fix, std::string_view code) {
    add(Diagnostic{"", 0, std::move(where), std::move(problem), std::move(fix), code});
  }
  void add(const std::vector<Diagnostic>& more) {
    for (const Diagnostic& fault : more) add(fault);
  }
  bool empty() const { return faults_.empty(); }
  bool is_full() const { return faults_.size() > kMaxFaults; }
  const std::vector<Diagnostic>& faults() const { return faults_; }
  void check() const {
    if (!faults_.empty()) throw InputError(faults_);
  }

 private:
  std::vector<Diagnostic> faults_;
};

// Throws InputError unless h [s] is positive and finite.
void check_step_size(double h);
// duration / h, rounded up, for a table with a row per step. Throws InputError above 1e7.
std::size_t stored_steps(double duration, double h);

}  // namespace twinarm
