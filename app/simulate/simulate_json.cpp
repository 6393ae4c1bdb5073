#include <fmt/format.h>

#include "app/dynamics/robot_json.h"
#include "app/simulate/simulate_output.h"
#include "solver/energy.h"

namespace twinarm {
namespace {

class JsonOutput : public RunOutput {
 public:
  JsonOutput(const RobotInput& input, const RunPlan& plan) : input_(input), k_(input.model) {
    json_.begin_object();
    json_.key("joints").texts(input.coordinates.names());
    json_.key("integrator").text(integrator_name(plan.integrator));
    if (plan.is_adaptive()) {
      plan.step_is_given ? json_.key("step").number(plan.step) : json_.key("step").null();
      json_.key("tolerance").number(plan.tolerance);
    } else {
      json_.key("step").number(plan.step);
    }
    json_.key("samples").begin_array();
  }

  void sample(double t, const State<double>& x) override {
    const Coordinates& coordinates = input_.coordinates;
    forward_kinematics(input_.model, x, k_);
    json_.begin_object();
    json_.key("t").number(t);
    write_coordinates(json_.key("q"), coordinates, x);
    write_velocities(json_.key("qd"), coordinates, x);
    if (coordinates.floating()) write_base(json_.key("base"), coordinates, x);
    write_links(json_.key("links"), input_.model, k_);
    json_.key("kinetic_energy").number(kinetic_energy(input_.model, x));
    json_.key("potential_energy").number(potential_energy(input_.model, x));
    json_.end_object();
  }

  void end(const RunResult& result) override {
    json_.end_array();
    json_.key("contacts").count(0);
    json_.key("ledger").begin_object();
    for (const LedgerRow& row : result.ledger) json_.key(row.name).number(row.work);
    json_.end_object();
    json_.key("steps").count(result.steps);
    if (result.post_mortem) write(*result.post_mortem);
    std::vector<std::string> warnings = input_.warnings;
    warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
    json_.key("warnings").texts(warnings);
    json_.end_object();
    fmt::print("{}\n", json_.str());
  }

 private:
  void write(const PostMortem& found) {
    json_.key("post_mortem").begin_object();
    json_.key("time").number(found.time);
    json_.key("step").count(found.step);
    json_.key("body").text(found.body);
    json_.key("joint").text(found.joint);
    json_.key("field").text(found.field);
    json_.key("fastest_joint").text(found.fastest_joint);
    json_.key("reason").text(found.reason);
    json_.end_object();
  }

  const RobotInput& input_;
  Kinematics k_;
  JsonWriter json_;
};

}  // namespace

std::unique_ptr<RunOutput> json_output(const RobotInput& input, const RunPlan& plan) {
  return std::make_unique<JsonOutput>(input, plan);
}

}  // namespace twinarm
