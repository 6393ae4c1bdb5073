#include <fmt/format.h>

#include "app/robot/robot_output.h"
#include "app/run/output/simulate_output.h"
#include "solver/dynamics/energy_momentum.h"

namespace twinarm {
namespace {

class JsonOutput : public RunOutput {
 public:
  JsonOutput(const SimulateInput& simulated, const RunPlan& plan, ForceSeries* forces)
      : input_(simulated.robot), simulated_(simulated), forces_(forces), k_(input_.model) {
    json_.begin_object();
    json_.members({{"schema", kJsonSchema},
                   {"joints", input_.coordinates.names()},
                   {"integrator", integrator_name(plan.integrator)}});
    const bool has_step = !plan.is_adaptive() || plan.step_is_given;
    json_.put("step", has_step ? std::optional(plan.step) : std::nullopt);
    if (plan.is_adaptive()) json_.put("tolerance", plan.tolerance);
    json_.key("samples").begin_array();
  }

  void sample(double t, const State<double>& x) override {
    const Coordinates& coordinates = input_.coordinates;
    forward_kinematics(input_.model, x, k_);
    json_.object([&] {
      json_.put("t", t);
      write_coordinates(json_.key("q"), coordinates, x);
      write_velocities(json_.key("qd"), coordinates, x);
      if (coordinates.floating()) write_base(json_.key("base"), coordinates, x);
      write_links(json_.key("links"), input_.model, k_);
      if (simulated_.couplings) write_targets(t);
      json_.members({{"kinetic_energy", kinetic_energy(input_.model, x)},
                     {"potential_energy", potential_energy(input_.model, x)}});
      if (forces_) forces_->read(x), forces_->write(json_);
    });
  }

  void end(const SimulateResult& result) override {
    json_.end_array();
    json_.put("contacts", result.contacts);
    json_.members(
        {{"largest_residual", result.residual}, {"largest_penetration", result.penetration}});
    write_rows("energy_balance", result.energy_balance);
    json_.key("momentum").object([&] {
      for (const MomentumRow& row : result.momentum)
        json_.key(row.name).object({{"linear", row.linear}, {"angular", row.angular}});
    });
    if (simulated_.couplings) write_rows("input_work", result.input_work);
    json_.put("steps", result.steps);
    if (result.alarm)
      json_.key("alarm").object({{"row", result.alarm->row},
                                 {"time", result.alarm->t},
                                 {"since", result.alarm->since},
                                 {"work", result.alarm->work},
                                 {"words", result.alarm_words}});
    if (result.post_mortem) write(*result.post_mortem);
    std::vector<std::string> warnings = input_.warnings;
    warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
    json_.key("warnings").texts(warnings);
    json_.end_object();
    fmt::print("{}\n", json_.str());
  }

 private:
  void write_rows(const char* key, const std::vector<EnergyRow>& rows) {
    json_.key(key).object([&] {
      for (const EnergyRow& row : rows) json_.put(row.name, row.work);
    });
  }
  // The target of each coupling: joints of its robot, and the end of the spring.
  void write_targets(double t) {
    json_.key("targets").object([&] {
      for (std::size_t c = 0; c < simulated_.couplings->size(); ++c)
        json_.put(simulated_.couplings->spec(c).name, [&] { write_target(c, t); });
    });
  }
  void write_target(std::size_t c, double t) {
    const SceneCoupling& spec = simulated_.couplings->spec(c);
    const TargetSample& kvr = simulated_.couplings->target(c, t);
    const auto body = static_cast<std::size_t>(spec.spring.body);
    const Vector3 p = kvr.k.position(spec.spring.body, spec.spring.p_L);
    const auto q = [&](const NamedJoint& j) { return coordinates_of(j, kvr.x); };
    const auto qd = [&](const NamedJoint& j) { return from_solver(j, kvr.x, kvr.x.qd); };
    json_.object({{"q", [&] { write_joints(spec, q); }},
                  {"qd", [&] { write_joints(spec, qd); }},
                  {"position", p},
                  {"orientation", quaternion_of(kvr.k.X_WL[body].R)},
                  {"linear_velocity", kvr.k.velocity(spec.spring.body, p)},
                  {"angular_velocity", kvr.k.w_WL[body]}});
  }
  template <class Values>
  void write_joints(const SceneCoupling& spec, const Values& values) {
    const auto [first, last] = simulated_.scene->bodies_of_robot(spec.robot);
    json_.begin_object();
    for (const NamedJoint& joint : input_.coordinates.all()) {
      const auto body = static_cast<int>(joint.body);
      const bool is_base = input_.coordinates.floating() && &joint == &input_.coordinates.base();
      if (body >= first && body <= last && !is_base)
        json_.key(joint.name).number_or_list(values(joint));
    }
    json_.end_object();
  }

  void write(const PostMortem& found) {
    json_.key("post_mortem").begin_object();
    json_.members({{"time", found.time},
                   {"step", found.step},
                   {"body", found.body},
                   {"joint", found.joint},
                   {"field", found.field},
                   {"fastest_joint", found.fastest_joint},
                   {"reason", found.reason},
                   {"pass", found.pass},
                   {"kinetic_energy", found.kinetic_energy}});
    if (found.by_energy) json_.key("energy_bound").number(found.energy_bound);
    json_.members({{"energy_row", found.row}, {"energy_row_growth", found.row_growth}});
    json_.key("violations").list(found.violations, [&](const StabilityViolation& violation) {
      write(violation);
    });
    json_.members({{"recording", found.recording}, {"words", found.words}});
    json_.end_object();
  }

  void write(const StabilityViolation& violation) {
    json_.object({{"name", violation.name},
                  {"scheme", violation.scheme},
                  {"omega_h", violation.product},
                  {"stability_limit", violation.limit},
                  {"step", violation.step},
                  {"max_stable_step", violation.max_step},
                  {"gain", violation.gain},
                  {"max_stable_gain", violation.max_gain}});
  }

  const RobotInput& input_;
  const SimulateInput& simulated_;
  ForceSeries* forces_;
  Kinematics k_;
  JsonWriter json_;
};

}  // namespace

std::unique_ptr<RunOutput> json_output(const SimulateInput& input, const RunPlan& plan,
                                       ForceSeries* forces) {
  return std::make_unique<JsonOutput>(input, plan, forces);
}

}  // namespace twinarm
