#include "app/run/output/simulate_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "app/data/tables.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

void sum_up(EnergyRow& sum, const EnergyRow& row) {
  sum.work += row.work;
}
void sum_up(MomentumRow& sum, const MomentumRow& row) {
  sum.linear += row.linear;
  sum.angular += row.angular;
}

// Name of the sum of all rows of a kind; nullptr for kinds that are not summed.
const char* name_of_sum(EnergyRowKind kind) {
  static constexpr std::pair<EnergyRowKind, const char*> kSums[] = {
      {EnergyRowKind::contact, "contact, all"},
      {EnergyRowKind::contact_normal, "contact, all/normal"},
      {EnergyRowKind::contact_friction, "contact, all/friction"},
      {EnergyRowKind::contact_impact, "contact, all/impact"},
      {EnergyRowKind::contact_stabilisation, "contact, all/stabilisation"},
      {EnergyRowKind::constraint, "constraint, all"},
      {EnergyRowKind::constraint_stabilisation, "constraint, all/stabilisation"}};
  for (const auto& [summed, name] : kSums)
    if (summed == kind) return name;
  return nullptr;
}

// Sums rows of contacts and constraints by kind if there are many; the JSON has them all.
template <class Row>
std::vector<Row> shortened(const std::vector<Row>& rows) {
  constexpr std::ptrdiff_t kMaxRows = 12;
  const auto is_summed = [](const Row& row) { return name_of_sum(row.kind) != nullptr; };
  if (std::ranges::count_if(rows, is_summed) <= kMaxRows) return rows;
  std::vector<Row> out;
  for (const Row& row : rows) {
    const auto same = std::ranges::find_if(
        out, [&](const Row& other) { return is_summed(row) && other.kind == row.kind; });
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
  MomentumRow sum{EnergyRowKind::earlier, "change of momentum", Vector3::Zero(), Vector3::Zero()};
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
      : input_(input.robot), plan_(plan), samples_(headings(input)), k_(input_.model) {}

  void sample(double t, const State<double>& x) override {
    forward_kinematics(input_.model, x, k_);
    const std::vector<double> values = run_values(input_, x, k_);
    std::vector<std::string> row{cell(t)};
    for (const std::size_t column : shown_) row.push_back(cell(values[column]));
    row.push_back(cell(values[values.size() - 2] + values.back()));
    samples_.add(std::move(row));
  }

  void end(const SimulateResult& result) override {
    const std::string steps = plan_.is_adaptive()
                                  ? fmt::format("tolerance {}", cell(plan_.tolerance))
                                  : fmt::format("step {} s", cell(plan_.step));
    fmt::print("{}: {} step{} of {}, {}\n\n{}{}\n", input_.robot.name, result.steps,
               result.steps == 1 ? "" : "s", integrator_name(plan_.integrator), steps,
               samples_.str(), left_out());
    TextTable energy_balance({"energy balance, 0 to " + cell(result.end) + " s", "work [J]"});
    double sum = 0;
    for (const EnergyRow& row : shortened(result.energy_balance)) {
      energy_balance.add({row.name, cell(row.work)});
      sum += row.work;
    }
    energy_balance.add({"change of kinetic energy", cell(sum)});
    fmt::print("{}\n{}", energy_balance.str(), momentum_table(result));
    if (result.contacts > 0)
      fmt::print("\n{} at the end; in all steps penetration up to {} m, residual up to {} m/s\n",
                 result.contacts == 1 ? "1 active contact point"
                                      : fmt::format("{} active contact points", result.contacts),
                 cell(result.penetration), cell(result.residual));
  }

 private:
  std::string left_out() const {
    if (bodies_ <= kShownBodies) return "";
    return fmt::format("({} of {} bodies are not shown: --csv and --json have them all)\n",
                       bodies_ - kShownBodies, bodies_);
  }

  // Coordinates, positions of the first bodies of a scene, energies.
  std::vector<std::string> headings(const SimulateInput& input) {
    const int bodies = input.robot.model.body_count();
    const int first = input.scene ? input.scene->robot_bodies + 1 : bodies;
    bodies_ = bodies - first;
    std::vector<std::string> names{"t [s]"};
    const std::vector<RunColumn> columns = run_columns(input.robot);
    int positions = 0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const auto& [name, unit, kind, of] = columns[i];
      if (kind == "rate") continue;
      if (kind == "position") {
        const int body = 1 + positions++ / 3;
        if (body < first || body >= first + kShownBodies) continue;
      }
      shown_.push_back(i);
      names.push_back((kind == "energy" ? of : name.substr(name.find('/') + 1)) + " [" + unit +
                      "]");
    }
    names.push_back("total energy [J]");
    return names;
  }

  static constexpr int kShownBodies = 3;
  const RobotInput& input_;
  const RunPlan& plan_;
  int bodies_ = 0;                  // of the scene, after its robots
  std::vector<std::size_t> shown_;  // of run_columns()
  TextTable samples_;
  Kinematics k_;
};

class CsvOutput : public RunOutput {
 public:
  CsvOutput(const RobotInput& input, ForceSeries* forces)
      : input_(input), forces_(forces), k_(input.model) {
    std::vector<std::string> header{"t[s]"};
    for (const RunColumn& column : run_columns(input, forces)) header.push_back(column.with_unit());
    fmt::print("{}\n", csv_line(header));
  }

  void sample(double t, const State<double>& x) override {
    forward_kinematics(input_.model, x, k_);
    std::vector<double> row = run_values(input_, x, k_, forces_);
    row.insert(row.begin(), t);
    fmt::print("{}\n", csv_line(row));
  }

  void end(const SimulateResult&) override {}

 private:
  const RobotInput& input_;
  ForceSeries* forces_;
  Kinematics k_;
};

}  // namespace

std::unique_ptr<RunOutput> table_output(const SimulateInput& input, const RunPlan& plan) {
  return std::make_unique<TableOutput>(input, plan);
}

std::unique_ptr<RunOutput> csv_output(const SimulateInput& input, ForceSeries* forces) {
  return std::make_unique<CsvOutput>(input.robot, forces);
}

}  // namespace twinarm
