#include <fmt/format.h>

#include "app/inspect/report/inspect_output.h"

namespace twinarm {
namespace {

constexpr double kZeroForce = 1e-13;  // relative to the largest force

Vector6 six_of(const NamedWrench& wrench) {
  return (Vector6() << wrench.force, wrench.torque).finished();
}

std::string dof_label(const Inspection& in, std::size_t body, std::size_t dof) {
  std::string text = joint_label(in, body);
  if (in.model.dofs(body) > 1) text += fmt::format("[{}]", dof - in.model.iv[body] + 1);
  return text;
}

const char* force_unit(const Inspection& in, std::size_t body) {
  if (in.model.dofs(body) > 1) return "";
  return is_translational(in.model.joint[body]) ? "N" : "N m";
}

void write_joint_balance(const Inspection& in, const JointBalance& joint, Sheet& sheet) {
  double largest = 0;
  for (const JointBalance::Torque& torque : joint.torques)
    largest = std::max(largest, std::abs(torque.value));
  if (largest <= kZeroForce * joint.largest) return;
  std::string text = fmt::format("      along {}", dof_label(in, joint.body, joint.dof));
  if (const std::string unit = force_unit(in, joint.body); !unit.empty()) text += " [" + unit + "]";
  for (std::size_t k = 0; k < joint.torques.size(); ++k)
    text += fmt::format("{} {} {}", k ? "," : ":", joint.torques[k].source,
                        short_number(joint.torques[k].value, joint.largest));
  sheet.line(wrapped(text, 10));
}

// Whether it acts on one of the bodies in view.
bool acts_in_view(const InspectView& view, const NamedForce& named) {
  const auto is_shown = [&](std::size_t body) {
    return std::ranges::find(view.bodies, body) != view.bodies.end();
  };
  return std::ranges::any_of(named.ends,
                             [&](const NamedForce::End& end) { return is_shown(end.body); }) ||
         std::ranges::any_of(named.joints,
                             [&](const NamedForce::OnJoint& on) { return is_shown(on.body); });
}

std::string point_text(const Vector3& p) {
  const double size = p.lpNorm<Eigen::Infinity>();
  return fmt::format("({}, {}, {})", short_number(p.x(), size), short_number(p.y(), size),
                     short_number(p.z(), size));
}

// "world axes, about its link's origin".
std::string viewpoint_text(const InspectView& view) {
  using Axes = Viewpoint::Axes;
  using About = Viewpoint::About;
  const std::string axes = view.from.axes == Axes::world ? "world axes"
                           : view.from.axes == Axes::own ? "axes of its link"
                                                         : "axes of " + view.axes;
  const std::string about = view.from.about == About::own_origin ? "its link's origin"
                            : view.from.about == About::own_com  ? "its centre of mass"
                            : view.from.about == About::body     ? "the origin of " + view.about
                                                                 : "(" + view.about + ") m";
  return axes + ", about " + about;
}

}  // namespace

std::vector<NamedForce> forces_in_view(const Inspection& in, const InspectView& view) {
  std::vector<NamedForce> all = named_forces(in, view.from);
  if (view.forces_alone)
    std::erase_if(all, [&](const NamedForce& named) {
      return std::ranges::find(view.forces, named.force->source) == view.forces.end();
    });
  return all;
}

void write_balances(const Inspection& in, const InspectView& view, Sheet& sheet) {
  sheet.title("WRENCHES ON EACH BODY: force [N] | torque [N m]", viewpoint_text(view));
  const std::vector<JointBalance> joints = joint_balances(in);
  for (const std::size_t body : view.bodies) {
    const BodyBalance balance = balance_of(in, body, view.from);
    sheet.line("\n" + in.model.body_name[body]);
    const Vector6 size = Vector6::Constant(balance.largest);
    for (const NamedWrench& wrench : balance.wrenches)
      sheet.row(wrench.source, six_of(wrench), size);
    sheet.line(fmt::format("      sum: zero, relative residual {:.1e} (largest {})",
                           balance.residual, short_number(balance.largest)));
    for (const JointBalance& joint : joints)
      if (joint.body == body) write_joint_balance(in, joint, sheet);
  }
}

void write_named_forces(const Inspection& in, const InspectView& view, Sheet& sheet) {
  std::vector<NamedForce> all = forces_in_view(in, view);
  if (!view.forces_alone)
    std::erase_if(all, [&](const NamedForce& named) {
      return !named.force->is_interaction || !acts_in_view(view, named);
    });
  if (all.empty()) return;
  sheet.title("NAMED FORCES on moving bodies: force [N] | torque [N m]", viewpoint_text(view));
  for (const NamedForce& named : all) {
    std::string head = "\n" + named.force->source;
    if (named.force->point_W) head += " at " + point_text(*named.force->point_W);
    if (named.parts)
      head += fmt::format(": normal {} N, friction {} N", short_number(named.parts->normal),
                          short_number(named.parts->friction, named.parts->normal));
    if (!named.force->is_unique) head += " *";
    sheet.line(head);
    for (const NamedForce::End& end : named.ends)
      sheet.row("on " + in.model.body_name[end.body], six_of(end.wrench),
                Vector6::Constant(six_of(end.wrench).lpNorm<Eigen::Infinity>()));
    for (const NamedForce::OnJoint& on : named.joints)
      sheet.line(fmt::format("      along {}: {} {}", dof_label(in, on.body, on.dof),
                             short_number(on.value), force_unit(in, on.body)));
  }
  if (!std::ranges::all_of(all, [](const NamedForce& named) { return named.force->is_unique; }))
    sheet.line(wrapped(
        "\n* not unique: other values of these constraint forces give the same accelerations; "
        "their sum on each body is determined"));
}

void add_by_joint(const Model<double>& model, const std::vector<double>& tau,
                  const std::string& before, const std::string& after,
                  std::vector<AppliedForce>& actors) {
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const std::string& joint = model.joint_name[i];
    AppliedForce actor{before + (joint.empty() ? "base" : joint) + after, {}, {}};
    for (std::size_t dof = model.iv[i]; dof < model.iv[i] + model.dofs(i); ++dof)
      if (tau[dof] != 0) actor.joints.push_back({dof, tau[dof], 0});
    if (!actor.joints.empty()) actors.push_back(std::move(actor));
  }
}

std::vector<AppliedForce> given_actors(const RobotInput& input, const State<double>& x) {
  std::vector<AppliedForce> actors;
  std::vector<double> tau(input.model.nv);
  for (const NamedJoint& joint : input.coordinates.all())
    to_solver(joint, x, input.state.tau.data() + joint.row, tau);
  add_by_joint(input.model, tau, "actuator/", "", actors);
  const Kinematics k = kinematics_at(input.model, x);
  for (std::size_t i = 0; i < input.state.wrenches.size(); ++i) {
    const Wrench& wrench = input.state.wrenches[i];
    AppliedForce actor{
        "wrench/" + std::to_string(i), {{wrench.body, in_body_axes(wrench, k), {}}}, {}};
    actor.is_interaction = true;
    actor.point_W = wrench.in_link_axes ? k.X_WL[wrench.body] * wrench.point : wrench.point;
    actors.push_back(std::move(actor));
  }
  for (const PointSpring& spring : input.springs) {
    PointSprings alone({spring});
    Forces<double> added(input.model);
    alone.add_forces(x, k, added);
    actors.push_back(actor_of("spring/" + spring.name, added));
    actors.back().is_interaction = true;
    actors.back().point_W = k.position(spring.b.body, spring.b.p_L);
  }
  return actors;
}

Inspected inspect_robot(const RobotInput& input) {
  const Model<double>& model = input.model;
  Inspected inspected{input.state.x, given_actors(input, input.state.x), input.warnings, {}, {}};
  ForwardDynamics dynamics(model);
  Workspace<double> w(model);
  Forces<double> forces = sum_of(model, inspected.actors);
  dynamics(inspected.x, forces, w);
  add_by_joint(model, dynamics.torques().damping, "joint/", "/damping", inspected.actors);
  add_by_joint(model, dynamics.torques().coulomb, "joint/", "/friction", inspected.actors);
  add_by_joint(model, dynamics.torques().mimic, "joint/", "/mimic", inspected.actors);
  return inspected;
}

}  // namespace twinarm
