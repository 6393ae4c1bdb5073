#include <fmt/format.h>

#include <cstdio>

#include "app/run/output/simulate_output.h"
#include "app/run/run_columns.h"
#include "app/support/streams.h"
#include "app/support/text_fields.h"

namespace twinarm {
namespace {

// One line of values, in the order of the header.
class CsvOutput : public RunOutput {
 public:
  explicit CsvOutput(const RobotInput& input) : input_(input), k_(input.model) {
    std::vector<std::string> header{"t[s]"};
    for (const RunColumn& column : run_columns(input)) header.push_back(column.with_unit());
    fmt::print("{}\n", csv_line(header));
  }

  void sample(double t, const State<double>& x) override {
    forward_kinematics(input_.model, x, k_);
    std::vector<double> row = run_values(input_, x, k_);
    row.insert(row.begin(), t);
    fmt::print("{}\n", csv_line(row));
  }

  // The ledger has no place in a table of samples.
  void end(const SimulateResult& result) override {
    std::fflush(stdout);
    for (const auto* warnings : {&input_.warnings, &result.warnings})
      for (const std::string& warning : *warnings) say("warning: {}\n", warning);
  }

 private:
  const RobotInput& input_;
  Kinematics k_;
};

}  // namespace

std::unique_ptr<RunOutput> csv_output(const SimulateInput& input) {
  return std::make_unique<CsvOutput>(input.robot);
}

}  // namespace twinarm
