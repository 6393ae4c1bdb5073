#include "app/draw/snapshot.h"

namespace twinarm {
namespace {

// One operator motion moves the gripper of at most one of them.
bool is_same_target(const SceneCoupling& a, const SceneCoupling& b) {
  return a.has_motion_of(b) && a.rest.q == b.rest.q &&
         (a.driven.gripper.empty() || b.driven.gripper.empty() ||
          a.driven.gripper == b.driven.gripper);
}

// One coupling for each target robot that is drawn: of several with the same target the one that
// moves its gripper too. Targets at the start are drawn only if the robot has no other target.
std::vector<std::size_t> shown_couplings(const SceneModel& scene) {
  const auto& all = scene.couplings;
  std::vector<std::size_t> found;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const auto outranks = [&](const SceneCoupling& other) {
      return other.robot == all[c].robot && other.target.kind != CouplingTarget::Kind::start;
    };
    if (all[c].target.kind == CouplingTarget::Kind::start && std::ranges::any_of(all, outranks))
      continue;
    const auto same = std::ranges::find_if(
        found, [&](std::size_t other) { return is_same_target(all[c], all[other]); });
    if (same == found.end())
      found.push_back(c);
    else if (all[*same].driven.gripper.empty())
      *same = c;
  }
  return found;
}

ShownCouplingForce coupling_force_of(const SceneModel& scene, SceneCouplings& couplings,
                                     std::size_t c, const Snapshot& snapshot,
                                     const Vector3& force) {
  const SceneCoupling& spec = scene.couplings[c];
  const CouplingEnds ends = couplings.ends(c, snapshot.x, snapshot.k);
  ShownCouplingForce shown;
  shown.name = spec.name;
  shown.kind = kind_of_coupling(scene, c);
  shown.has_ends = spec.type == CouplingDescription::Type::linear;
  shown.body = static_cast<std::size_t>(spec.spring.body);
  shown.force_W = force;
  shown.energy = 0.5 * spec.spring.k * ends.offset.squaredNorm();
  if (shown.has_ends) {
    shown.p_D = snapshot.k.position(spec.spring.body, spec.spring.p_L);
    shown.p_K = shown.p_D + ends.offset;
    return shown;
  }
  shown.p_D = shown.p_K = snapshot.k.X_WL[shown.body].p;
  // The axis of a joint with one degree of freedom is z of the body frame.
  if (spec.measure == SpringSpace::joint)
    shown.force_W = force.x() * snapshot.k.R_WB[shown.body].col(2);
  return shown;
}

}  // namespace

ShownCouplingForce::Kind kind_of_coupling(const SceneModel& scene, std::size_t coupling) {
  const SceneCoupling& spec = scene.couplings[coupling];
  const bool along_joint =
      spec.measure == SpringSpace::joint &&
      is_translational(scene.model.joint[static_cast<std::size_t>(spec.spring.body)]);
  return spec.type == CouplingDescription::Type::linear || along_joint
             ? ShownCouplingForce::Kind::force
             : ShownCouplingForce::Kind::couple;
}

std::vector<PairForce> pair_forces(const Snapshot& snapshot) {
  struct Sum {
    PairForce pair;
    double weight = 0;
  };
  std::map<std::pair<int, int>, Sum> sums;
  for (const ShownContact& contact : snapshot.contacts) {
    Sum& sum = sums[{contact.a, contact.b}];
    const double weight = std::max(1e-12, contact.force_W.dot(contact.n_W));
    sum.pair.body_b = contact.body_b;
    sum.pair.force += contact.force_W;
    sum.pair.couple += contact.couple_W;
    sum.pair.point += weight * contact.p_W;
    sum.weight += weight;
  }
  std::vector<PairForce> all;
  for (auto& [name, sum] : sums) {
    sum.pair.point /= sum.weight;
    all.push_back(sum.pair);
  }
  return all;
}

Snapshot snapshot_of(const Model<double>& model, const State<double>& x) {
  Snapshot snapshot(model);
  snapshot.x = x;
  forward_kinematics(model, x, snapshot.k);
  snapshot.kinetic = kinetic_energy(model, x);
  snapshot.potential = potential_energy(model, x);
  return snapshot;
}

Snapshot snapshot_of(const SceneModel& scene, SceneCouplings& couplings, const State<double>& x,
                     const std::vector<Vector3>& forces) {
  Snapshot snapshot = snapshot_of(scene.model, x);
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    const Vector3 force = c < forces.size() ? forces[c] : Vector3(Vector3::Zero());
    snapshot.coupling_forces.push_back(coupling_force_of(scene, couplings, c, snapshot, force));
    snapshot.elastic += snapshot.coupling_forces.back().energy;
  }
  for (const std::size_t c : shown_couplings(scene)) {
    const SceneCoupling& spec = scene.couplings[c];
    snapshot.targets.push_back({spec.robot, couplings.target(c, x.t).k.X_WL});
    if (!spec.target.is_operator()) continue;
    const OperatorSample sampled = couplings.motion(c).sample(x.t, x.t + 1e-6);
    snapshot.devices.push_back({sampled.theta, sampled.button});
  }
  return snapshot;
}

Vector3 com_of(const Model<double>& model, const Kinematics& k, std::size_t body) {
  const Inertia<double>& I = model.I[body];
  if (!(I.m > 0)) return k.X_WL[body].p;
  return k.X_WL[body].p + k.R_WB[body] * to_eigen(I.h) / I.m;
}

// About the centre of mass c from that about the origin: I_c = I_o - m (c.c 1 - c c^T), c = h / m.
Matrix3 inertia_of(const Model<double>& model, const Kinematics& k, std::size_t body) {
  const Inertia<double>& I = model.I[body];
  Matrix3 I_B = to_eigen(full(I.I));
  if (I.m > 0) {
    const Vector3 h = to_eigen(I.h);
    I_B -= (h.squaredNorm() * Matrix3::Identity() - h * h.transpose()) / I.m;
  }
  return k.R_WB[body] * I_B * k.R_WB[body].transpose();
}

TotalMotion total_motion(const Model<double>& model, const Kinematics& k) {
  TotalMotion total;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const double m = model.I[i].m;
    if (!(m > 0)) continue;
    const Vector3 c = com_of(model, k, i);
    total.mass += m;
    total.com_W += m * c;
    total.linear += m * k.velocity(static_cast<int>(i), c);
  }
  if (!(total.mass > 0)) return total;
  total.com_W /= total.mass;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const double m = model.I[i].m;
    if (!(m > 0)) continue;
    const Vector3 c = com_of(model, k, i);
    const Vector3 p = m * k.velocity(static_cast<int>(i), c);
    total.angular += inertia_of(model, k, i) * k.w_WL[i] + (c - total.com_W).cross(p);
  }
  return total;
}

}  // namespace twinarm
