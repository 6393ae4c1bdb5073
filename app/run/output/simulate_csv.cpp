#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "app/robot/robot_table.h"
#include "app/run/output/simulate_output.h"
#include "app/support/streams.h"
#include "solver/dynamics/energy.h"
#include "solver/dynamics/kinematics.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

std::string quoted_where_needed(const std::string& name) {
  if (name.find_first_of(",\"\n") == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

// One line of values, in the order of the header.
class CsvOutput : public RunOutput {
 public:
  explicit CsvOutput(const RobotInput& input) : input_(input), k_(input.model) {
    std::vector<std::string> header{"t[s]"};
    const Coordinates& coordinates = input.coordinates;
    for (const NamedJoint& joint : coordinates.all())
      for (const JointComponent& c : joint.components())
        header.push_back("q/" + component_name(coordinates, joint, c) +
                         (c.is_quaternion ? "[1]"
                          : c.is_angle    ? "[rad]"
                                          : "[m]"));
    for (const NamedJoint& joint : coordinates.all())
      for (const JointComponent& c : joint.components())
        if (c.v >= 0)
          header.push_back("qd/" + component_name(coordinates, joint, c) +
                           (c.is_angle ? "[rad/s]" : "[m/s]"));
    for (std::size_t i = 1; i < input.model.parent.size(); ++i)
      for (const char* axis : {"/x[m]", "/y[m]", "/z[m]"})
        header.push_back("links/" + input.model.body_name[i] + axis);
    header.insert(header.end(), {"kinetic_energy[J]", "potential_energy[J]"});
    for (std::string& name : header) name = quoted_where_needed(name);
    fmt::print("{}\n", fmt::join(header, ","));
  }

  void sample(double t, const State<double>& x) override {
    std::vector<double> row{t};
    const auto add = [&](const std::vector<double>& v) {
      row.insert(row.end(), v.begin(), v.end());
    };
    for (const NamedJoint& joint : input_.coordinates.all()) add(coordinates_of(joint, x));
    for (const NamedJoint& joint : input_.coordinates.all()) add(from_solver(joint, x, x.qd));
    forward_kinematics(input_.model, x, k_);
    for (std::size_t i = 1; i < input_.model.parent.size(); ++i)
      row.insert(row.end(), k_.X_WL[i].p.begin(), k_.X_WL[i].p.end());
    row.push_back(kinetic_energy(input_.model, x));
    row.push_back(potential_energy(input_.model, x));
    std::string line;
    for (const double value : row) line += (line.empty() ? "" : ",") + number_text(value);
    fmt::print("{}\n", line);
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
