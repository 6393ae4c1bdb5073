#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/data/text_table.h"
#include "app/robot/robot_table.h"
#include "app/run/output/simulate_output.h"
#include "solver/dynamics/energy.h"
#include "solver/dynamics/kinematics.h"

namespace twinarm {
namespace {

void sum_up(LedgerRow& sum, const LedgerRow& row) {
  sum.work += row.work;
}
void sum_up(MomentumRow& sum, const MomentumRow& row) {
  sum.linear += row.linear;
  sum.angular += row.angular;
}

// Of the rows of a kind that are summed where there are many; others have none.
const char* name_of_sum(LedgerKind kind) {
  switch (kind) {
    case LedgerKind::contact:
      return "contact, all";
    case LedgerKind::contact_normal:
      return "contact, all/normal";
    case LedgerKind::contact_friction:
      return "contact, all/friction";
    case LedgerKind::contact_impact:
      return "contact, all/impact";
    case LedgerKind::contact_stabilisation:
      return "contact, all/stabilisation";
    case LedgerKind::constraint:
      return "constraint, all";
    case LedgerKind::constraint_stabilisation:
      return "constraint, all/stabilisation";
    default:
      return nullptr;
  }
}

// Rows of many contacts or constraints are summed by kind: the JSON has them all.
template <class Row>
std::vector<Row> shortened(const std::vector<Row>& rows) {
  constexpr std::ptrdiff_t most = 12;
  const auto is_summed = [](const Row& row) { return name_of_sum(row.kind) != nullptr; };
  if (std::count_if(rows.begin(), rows.end(), is_summed) <= most) return rows;
  std::vector<Row> out;
  for (const Row& row : rows) {
    const auto same = std::find_if(out.begin(), out.end(), [&](const Row& other) {
      return is_summed(row) && other.kind == row.kind;
    });
    if (same != out.end()) {
      sum_up(*same, row);
      continue;
    }
    out.push_back(row);
    if (is_summed(row)) out.back().name = name_of_sum(row.kind);
  }
  return out;
}

std::string momentum_table(const SimulateResult& result) {
  TextTable table({"momentum, 0 to " + cell(result.end) + " s", "x [N s]", "y [N s]", "z [N s]",
                   "about x [N m s]", "about y [N m s]", "about z [N m s]"});
  const auto line = [&](const MomentumRow& row) {
    std::vector<std::string> cells{row.name};
    for (const Vector3& v : {row.linear, row.angular})
      for (const double component : v) cells.push_back(cell(component));
    table.add(std::move(cells));
  };
  MomentumRow sum{LedgerKind::earlier, "change of momentum", Vector3::Zero(), Vector3::Zero()};
  for (const MomentumRow& row : shortened(result.momentum)) {
    if (!name_of_sum(row.kind) || !row.linear.isZero(0) || !row.angular.isZero(0)) line(row);
    sum_up(sum, row);
  }
  line(sum);
  return table.str();
}

class TableOutput : public RunOutput {
 public:
  TableOutput(const SimulateInput& input, const RunPlan& plan)
      : input_(input.robot),
        plan_(plan),
        first_body_(input.scene ? input.scene->robot_bodies + 1 : input_.model.body_count()),
        samples_(headings()),
        k_(input_.model) {}

  void sample(double t, const State<double>& x) override {
    std::vector<std::string> row{cell(t)};
    for (const NamedJoint& joint : input_.coordinates.all())
      for (const double q : coordinates_of(joint, x)) row.push_back(cell(q));
    forward_kinematics(input_.model, x, k_);
    for (int body = first_body_; body < end_of_bodies(); ++body)
      for (const double p : k_.X_WL[static_cast<std::size_t>(body)].p) row.push_back(cell(p));
    const double kinetic = kinetic_energy(input_.model, x);
    const double potential = potential_energy(input_.model, x);
    for (const double energy : {kinetic, potential, kinetic + potential})
      row.push_back(cell(energy));
    samples_.add(std::move(row));
  }

  void end(const SimulateResult& result) override {
    const std::string steps = plan_.is_adaptive()
                                  ? fmt::format("tolerance {}", cell(plan_.tolerance))
                                  : fmt::format("step {} s", cell(plan_.step));
    fmt::print("{}: {} step{} of {}, {}\n\n{}{}\n", input_.robot.name, result.steps,
               result.steps == 1 ? "" : "s", integrator_name(plan_.integrator), steps,
               samples_.str(), left_out());
    TextTable ledger({"work on the bodies, 0 to " + cell(result.end) + " s", "[J]"});
    double sum = 0;
    for (const LedgerRow& row : shortened(result.ledger)) {
      ledger.add({row.name, cell(row.work)});
      sum += row.work;
    }
    ledger.add({"change of kinetic energy", cell(sum)});
    fmt::print("{}\n{}", ledger.str(), momentum_table(result));
    if (result.contacts > 0)
      fmt::print("\n{} at the end\n",
                 result.contacts == 1 ? "1 contact point presses"
                                      : fmt::format("{} contact points press", result.contacts));
    const char* space = "\n";
    for (const auto* warnings : {&input_.warnings, &result.warnings})
      for (const std::string& warning : *warnings) {
        fmt::print("{}warning: {}\n", space, warning);
        space = "";
      }
  }

 private:
  // Of the bodies of a scene the first few have columns.
  int end_of_bodies() const { return std::min(input_.model.body_count(), first_body_ + 3); }
  std::string left_out() const {
    const int bodies = input_.model.body_count() - first_body_,
              shown = end_of_bodies() - first_body_;
    if (bodies <= shown) return "";
    return fmt::format("({} of {} bodies are not shown: --csv and --json have them all)\n",
                       bodies - shown, bodies);
  }

  std::vector<std::string> headings() const {
    const Coordinates& coordinates = input_.coordinates;
    std::vector<std::string> names{"t [s]"};
    for (const NamedJoint& joint : coordinates.all())
      for (const JointComponent& c : joint.components())
        names.push_back(component_name(coordinates, joint, c) + (c.is_quaternion ? " [1]"
                                                                 : c.is_angle    ? " [rad]"
                                                                                 : " [m]"));
    for (int body = first_body_; body < end_of_bodies(); ++body)
      for (const char* axis : {"/x [m]", "/y [m]", "/z [m]"})
        names.push_back(input_.model.body_name[static_cast<std::size_t>(body)] + axis);
    names.insert(names.end(), {"kinetic [J]", "potential [J]", "sum [J]"});
    return names;
  }

  const RobotInput& input_;
  const RunPlan& plan_;
  int first_body_;  // of the scene's own, after its robots
  TextTable samples_;
  Kinematics k_;
};

}  // namespace

std::unique_ptr<RunOutput> table_output(const SimulateInput& input, const RunPlan& plan) {
  return std::make_unique<TableOutput>(input, plan);
}

}  // namespace twinarm
