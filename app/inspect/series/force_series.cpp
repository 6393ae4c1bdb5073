#include "app/inspect/series/force_series.h"

#include <algorithm>
#include <array>

#include "app/robot/dynamics.h"
#include "app/robot/robot_output.h"

namespace twinarm {
namespace {

// Step of an inspection [s].
double step_of(const SimulatePlan& plan) {
  constexpr double kInstant = 1e-6;
  const bool by_step =
      facts_of(plan.run.integrator).implicit_force || plan.input.scene->may_touch();
  return by_step ? plan.run.step : kInstant;
}

void add_columns(const std::string& name, const std::string& kind, const std::string& of,
                 std::array<const char*, 2> prefixes, std::array<const char*, 2> units,
                 std::vector<RunColumn>& columns) {
  for (std::size_t part = 0; part < 2; ++part)
    for (const char* axis : {"x", "y", "z"})
      columns.push_back({name + "/" + prefixes[part] + axis, units[part], kind, of});
}

}  // namespace

ForceSeries::ForceSeries(const SimulateOptions& options) : plan_(prepare_simulation(options)) {
  const Model<double>& model = plan_.input.robot.model;
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    if (model.joint[i] != JointType::free && model.joint[i] != JointType::prescribed)
      jointed_.push_back(i);
  if (!plan_.input.scene) return;
  const SceneModel& scene = *plan_.input.scene;
  scene_.emplace(plan_.input, step_of(plan_), std::vector<NamedSource>{}, plan_.run.integrator);
  for (const SceneConstraint& c : scene.constraints)
    if (facts_of(c.type).ends == LoopBetween::bodies)
      named_.push_back({"constraint/" + c.name, static_cast<std::size_t>(c.a ? c.a : c.b)});
    else
      on_joints_.push_back({"constraint/" + c.name, static_cast<std::size_t>(c.a)});
  for (const PointSpring& spring : plan_.input.robot.springs)
    named_.push_back({"spring/" + spring.name,
                      static_cast<std::size_t>(spring.a.body ? spring.a.body : spring.b.body)});
  if (scene.may_touch())
    for (std::size_t i = 1; i < model.parent.size(); ++i)
      if (std::ranges::any_of(scene.geometries, [&](const SceneGeometry& geometry) {
            return geometry.body == static_cast<int>(i);
          }))
        touching_.push_back(i);
}

void ForceSeries::keep(SteppedRun& run) {
  const double slack = kSameTime * plan_.run.step, t = run.time();
  const auto sample = std::ranges::lower_bound(plan_.run.times, t - slack);
  if (sample != plan_.run.times.end() && *sample <= t + plan_.run.step + slack)
    memory_ = run.memory();
}

void ForceSeries::read(const State<double>& x) {
  RobotInput& robot = plan_.input.robot;
  now_.reset();
  Inspected found;
  if (scene_) {
    if (plan_.input.couplings) plan_.input.couplings->forget_operator_motions();
    StateArchive memory = simulation_memory(memory_);
    found = scene_->look(&memory, &x);
  } else {
    set_pose(robot, x);
    found = inspect_robot(robot);
  }
  now_.emplace(robot.model, std::move(found.x), std::move(found.actors), std::move(found.loops));
}

Vector3 ForceSeries::angular_acceleration(std::size_t body) const {
  return now_->k.R_WB[body] * to_eigen(now_->w.a[body].w);
}

ForceSeries::Wrench6 ForceSeries::in_world(const Force<double>& f, std::size_t body) const {
  const Matrix3& R = now_->k.R_WB[body];
  return {R * to_eigen(f.f), R * to_eigen(f.n)};
}

ForceSeries::Wrench6 ForceSeries::joint_wrench(std::size_t body) const {
  return in_world(joint_force(*now_, body), body);
}

ForceSeries::Wrench6 ForceSeries::wrench_of(const std::string& force, std::size_t body) const {
  for (const AppliedForce& actor : now_->actors)
    for (const AppliedForce::OnBody& on : actor.bodies) {
      if (actor.source != force || on.body != body) continue;
      Wrench6 wrench = in_world(now_->force_of(on), body);
      if (actor.point_W)
        wrench.torque -= (*actor.point_W - now_->k.X_WL[body].p).cross(wrench.force);
      return wrench;
    }
  return {};
}

double ForceSeries::torque_of(const std::string& force, std::size_t body) const {
  for (const AppliedForce& actor : now_->actors)
    for (const AppliedForce::OnJoint& on : actor.joints)
      if (actor.source == force && on.dof == now_->model.iv[body]) return now_->torque_of(on);
  return 0;
}

std::vector<ForceSeries::Wrench6> ForceSeries::sums_of_contacts() const {
  std::vector<Wrench6> sums(now_->body_count());
  for (const AppliedForce& actor : now_->actors) {
    if (!actor.normal_W) continue;
    for (const AppliedForce::OnBody& on : actor.bodies) {
      const Wrench6 wrench = in_world(now_->force_of(on), on.body);
      sums[on.body].force += wrench.force;
      sums[on.body].torque += wrench.torque;
    }
  }
  return sums;
}

void ForceSeries::write(JsonWriter& json) const {
  const RobotInput& robot = plan_.input.robot;
  const Model<double>& model = robot.model;
  State<double> rates = now_->x;
  rates.qd = now_->w.qdd;
  write_velocities(json.key("qdd"), robot.coordinates, rates);
  json.key("accelerations").object([&] {
    for (std::size_t i = 1; i < model.parent.size(); ++i)
      json.key(model.body_name[i])
          .object({{"linear", now_->origin_acceleration(i)}, {"angular", angular_acceleration(i)}});
  });
  json.key("joint_forces").object([&] {
    for (const std::size_t i : jointed_) {
      const Wrench6 wrench = joint_wrench(i);
      json.key(joint_label(*now_, i)).object({{"force", wrench.force}, {"torque", wrench.torque}});
    }
  });
  write_forces(json.key("forces"), *now_, InspectView{});
}

std::vector<RunColumn> ForceSeries::columns() const {
  const RobotInput& robot = plan_.input.robot;
  const Model<double>& model = robot.model;
  std::vector<RunColumn> columns;
  for (const NamedJoint& joint : robot.coordinates.all())
    for (const JointComponent& c : joint.components())
      if (c.v >= 0) {
        const std::string of = component_name(robot.coordinates, joint, c);
        columns.push_back({"qdd/" + of, c.is_angle ? "rad/s^2" : "m/s^2", "acceleration", of});
      }
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    add_columns("links/" + model.body_name[i], "acceleration", model.body_name[i], {"a", "alpha_"},
                {"m/s^2", "rad/s^2"}, columns);
  const auto add_wrench = [&](const std::string& name, const std::string& of) {
    add_columns(name, "force", of, {"f", "n"}, {"N", "N m"}, columns);
  };
  for (const std::size_t i : jointed_)
    add_wrench("joint/" + model.joint_name[i], model.joint_name[i]);
  for (const OnBody& on : named_) add_wrench(on.force, on.force);
  for (const OnBody& on : on_joints_)
    columns.push_back(
        {on.force, is_translational(model.joint[on.body]) ? "N" : "N m", "force", on.force});
  for (const std::size_t i : touching_)
    add_wrench("contacts/" + model.body_name[i], model.body_name[i]);
  return columns;
}

std::vector<double> ForceSeries::values() const {
  std::vector<double> values;
  const auto add = [&](const auto& several) {
    values.insert(values.end(), several.begin(), several.end());
  };
  const auto add_wrench = [&](const Wrench6& wrench) { add(wrench.force), add(wrench.torque); };
  for (const NamedJoint& joint : plan_.input.robot.coordinates.all())
    add(from_solver(joint, now_->x, now_->w.qdd));
  for (std::size_t i = 1; i < now_->body_count(); ++i)
    add(now_->origin_acceleration(i)), add(angular_acceleration(i));
  for (const std::size_t i : jointed_) add_wrench(joint_wrench(i));
  for (const OnBody& on : named_) add_wrench(wrench_of(on.force, on.body));
  for (const OnBody& on : on_joints_) values.push_back(torque_of(on.force, on.body));
  const std::vector<Wrench6> contacts = sums_of_contacts();
  for (const std::size_t i : touching_) add_wrench(contacts[i]);
  return values;
}

std::vector<RunColumn> run_columns(const RobotInput& input, const ForceSeries* forces) {
  std::vector<RunColumn> columns = run_columns(input);
  if (!forces) return columns;
  const std::vector<RunColumn> more = forces->columns();
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

std::vector<double> run_values(const RobotInput& input, const State<double>& x, const Kinematics& k,
                               ForceSeries* forces) {
  std::vector<double> values = run_values(input, x, k);
  if (!forces) return values;
  forces->read(x);
  const std::vector<double> more = forces->values();
  values.insert(values.end(), more.begin(), more.end());
  return values;
}

}  // namespace twinarm
