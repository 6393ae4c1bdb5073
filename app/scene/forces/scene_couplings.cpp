#include "app/scene/forces/scene_couplings.h"

#include "solver/forces/joint_stops.h"
#include "solver/forces/spring.h"

namespace twinarm {
namespace {

// Steps between two evaluations of a held force; 0: evaluated in each step.
int hold_steps(const SceneModel& scene, const SceneCoupling& coupling, double h,
               DiagnosticList& faults) {
  if (coupling.rate == 0) return 0;
  const double steps = 1 / (coupling.rate * h), whole = std::round(steps);
  if (whole >= 1 && std::abs(steps - whole) <= 1e-6 * whole) return static_cast<int>(whole);
  faults.add({scene.description.file.string(), coupling.line,
              "coupling '" + coupling.coupling + "'",
              "the interval of " + short_number_text(coupling.rate) + " Hz is " +
                  short_number_text(steps) + " steps of " + short_number_text(h) + " s",
              "choose rate and step so that it is a whole number", "scene.rate"});
  return 1;
}

// Matched law: offset J_K (q_K - q_D), velocities J_K qd_K and J_K qd_D.
CouplingEnds matched_ends(const Model<double>& model, const Spring& spring, const TargetSample& kvr,
                          const State<double>& x) {
  CouplingEnds ends;
  const Eigen::Matrix3Xd J =
      point_jacobian(model, kvr.k, spring.body, kvr.k.position(spring.body, spring.p_L));
  for (int body = spring.body; body > 0; body = model.parent[static_cast<std::size_t>(body)]) {
    const auto i = static_cast<std::size_t>(body);
    if (model.dofs(i) != 1) continue;
    const Vector3 column = J.col(static_cast<Eigen::Index>(model.iv[i]));
    ends.offset += column * (kvr.x.q[model.iq[i]] - x.q[model.iq[i]]);
    ends.velocity += column * x.qd[model.iv[i]];
    ends.target_velocity += column * kvr.x.qd[model.iv[i]];
  }
  return ends;
}

JointStops::Stop stop_of(const SceneCoupling& spec) {
  return {spec.spring.body, spec.soft_limits->first, spec.soft_limits->second, spec.spring.k,
          spec.spring.b};
}

// Couplings with the same motion share a target robot, to compute its kinematics once.
bool share_target(const SceneCoupling& a, const SceneCoupling& b) {
  return a.has_motion_of(b) && a.driven == b.driven && a.absolute_damper == b.absolute_damper &&
         a.rest.q == b.rest.q;
}

}  // namespace

struct SceneCouplings::Target {
  Target(const SceneModel& scene, const SceneCoupling& spec, std::unique_ptr<OperatorMotion> given)
      : motion(std::move(given)),
        kvr(scene.model, *motion, {}, spec.driven,
            spec.absolute_damper ? TargetRates::none : TargetRates::from_operator),
        shown_after(scene.model, *motion, {}, spec.driven),
        shown_before(shown_after) {
    kvr.set_pose(spec.rest);
    shown_after.set_pose(spec.rest);
    shown_before.set_pose(spec.rest);
  }

  std::unique_ptr<OperatorMotion> motion;
  TargetRobot kvr;
  TargetRobot shown_after, shown_before;  // by side
};

struct SceneCouplings::Active {
  Active(const SceneModel& scene, const SceneCoupling& spec, double h,
         std::shared_ptr<Target> shared, DiagnosticList& faults)
      : target(std::move(shared)) {
    law.name = spec.coupling;
    law.type = spec.law;
    law.printed = spec.printed;
    law.measure = spec.measure;
    law.discretization = spec.discretization;
    law.hold_steps = hold_steps(scene, spec, h, faults);
    law.options.hold_steps = law.hold_steps;
    law.reference = spec.reference;
    law.springs = spec.springs;
    if (spec.soft_limits) {
      source = std::make_unique<JointStops>(spec.coupling, scene.model,
                                            std::vector<JointStops::Stop>{stop_of(spec)});
      return;
    }
    try {
      source = make_coupling(law, scene.model, target->kvr);
    } catch (const InputError& error) {
      for (Diagnostic fault : error.faults()) {
        fault.file = scene.description.file.string();
        fault.line = spec.line;
        faults.add(fault);
      }
    }
  }

  std::shared_ptr<Target> target;
  CouplingSpec law;
  std::unique_ptr<SpringSource> source;  // a Coupling, or JointStops for soft limits
};

SceneCouplings::SceneCouplings(const SceneModel& scene, double h, const OperatorMotion* device,
                               const MotionReplacement& in_place)
    : scene_(scene) {
  DiagnosticList faults;
  const auto target_of = [&](std::size_t c) {
    for (std::size_t before = 0; before < c; ++before)
      if (share_target(scene.couplings[before], scene.couplings[c]))
        return couplings_[before]->target;
    return std::make_shared<Target>(scene, scene.couplings[c],
                                    make_operator_motion(scene, c, device, in_place, faults));
  };
  for (std::size_t c = 0; c < scene.couplings.size(); ++c)
    couplings_.push_back(
        scene.couplings[c].first_component != c
            ? couplings_.back()
            : std::make_shared<Active>(scene, scene.couplings[c], h, target_of(c), faults));
  faults.check();
}

SceneCouplings::~SceneCouplings() = default;

ForceSource* SceneCouplings::source(std::size_t c) {
  return spec(c).first_component == c ? couplings_[c]->source.get() : nullptr;
}

void SceneCouplings::forget_operator_motions() {
  for (const std::shared_ptr<Active>& active : couplings_) {
    active->target->kvr.invalidate();
    active->target->shown_after.invalidate();
    active->target->shown_before.invalidate();
  }
}
const OperatorMotion& SceneCouplings::motion(std::size_t c) const {
  return *couplings_[c]->target->motion;
}

const Coupling& SceneCouplings::coupling(std::size_t c) const {
  return dynamic_cast<const Coupling&>(*couplings_[c]->source);
}

const TargetSample& SceneCouplings::target(std::size_t c, double t, Side side) {
  constexpr double part = 1e-6;  // on that side of a corner [s]
  Target& target = *couplings_[c]->target;
  return side == Side::after ? target.shown_after.at(t, t + part)
                             : target.shown_before.at(t, t - part);
}

CouplingEnds SceneCouplings::ends(std::size_t c, const State<double>& x, const Kinematics& k,
                                  Side side) {
  const SceneCoupling& spec = scene_.couplings[c];
  const TargetSample& kvr = target(c, x.t, side);
  const auto i = static_cast<std::size_t>(spec.spring.body);
  CouplingEnds ends;
  if (spec.law == CouplingSpec::Type::equivalent_torsional) {
    ends = matched_ends(scene_.model, spec.spring, kvr, x);
  } else if (spec.is_linear()) {
    const Vector3 p_D = k.position(spec.spring.body, spec.spring.p_L);
    const Vector3 p_K = kvr.k.position(spec.spring.body, spec.spring.p_L);
    ends = {p_K - p_D, k.velocity(spec.spring.body, p_D), kvr.k.velocity(spec.spring.body, p_K)};
  } else if (spec.measure == SpringSpace::world) {
    ends = {rotation_vector(kvr.k.X_WL[i].R * k.X_WL[i].R.transpose()), k.w_WL[i], kvr.k.w_WL[i]};
  } else {
    const std::size_t iq = scene_.model.iq[i], iv = scene_.model.iv[i];
    ends.offset.x() = kvr.x.q[iq] - x.q[iq];
    ends.velocity.x() = x.qd[iv];
    ends.target_velocity.x() = kvr.x.qd[iv];
    if (spec.soft_limits) {  // soft limits are at rest; no force between them
      ends.offset.x() = stop_of(spec).way_back(x.q[iq]);
      ends.target_velocity.x() = ends.offset.x() == 0 ? x.qd[iv] : 0;
    }
  }
  return ends;
}

Vector3 SceneCouplings::force(std::size_t c) const {
  const SceneCoupling& spec = scene_.couplings[c];
  const SpringState& reading = couplings_[c]->source->readings()[spec.reading(c)];
  return spec.at_joint() ? Vector3(reading.size, 0, 0) : reading.force_W;
}

const CouplingSpec& SceneCouplings::law(std::size_t c) const {
  return couplings_[c]->law;
}

const TargetRobot& SceneCouplings::kvr(std::size_t c) const {
  return couplings_[c]->target->kvr;
}

double SceneCouplings::m_star(std::size_t c) const {
  return couplings_[c]->source->readings()[scene_.couplings[c].reading(c)].m_star;
}

void SceneCouplings::hold_still(std::size_t c, const State<double>& x, const Kinematics& k,
                                Forces<double>& forces) {
  const SceneCoupling& given = spec(c);
  const CouplingEnds at = ends(c, x, k);
  // Between soft limits the damper has no force.
  const Vector3 along = given.soft_limits ? at.target_velocity : Vector3(Vector3::Zero());
  const Vector3 force = given.spring.k * at.offset - given.spring.b * (at.velocity - along);
  const int body = given.spring.body;
  if (given.is_linear())
    add_point_force(k, body, k.position(body, given.spring.p_L), force, forces);
  else if (given.measure == SpringSpace::world)
    add_couple(k, body, force, forces);
  else
    forces.tau[scene_.model.iv[static_cast<std::size_t>(body)]] += force.x();
}

}  // namespace twinarm
