#include "app/draw/snapshot.h"

#include <algorithm>
#include <map>
#include <utility>

#include "solver/dynamics/energy_momentum.h"

namespace twinarm {
namespace {

bool same_motion(const SceneCoupling& a, const SceneCoupling& b) {
  return a.robot == b.robot && a.target == b.target && a.trace == b.trace && a.rest.q == b.rest.q &&
         a.delay == b.delay && a.speed == b.speed && a.seed == b.seed;
}

// The hand that leads both moves the gripper of one of them at most.
bool is_one_twin(const SceneCoupling& a, const SceneCoupling& b) {
  return same_motion(a, b) && (a.driven.gripper.empty() || b.driven.gripper.empty() ||
                               a.driven.gripper == b.driven.gripper);
}

// One coupling for each kinematic side that is to be seen; of those with one twin the one that
// moves its gripper too. Where one of a robot's couplings leads it somewhere, those that hold it at
// its start have nothing to show.
std::vector<std::size_t> leaders(const SceneModel& scene) {
  const auto& all = scene.couplings;
  std::vector<std::size_t> found;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const auto outranks = [&](const SceneCoupling& other) {
      return other.robot == all[c].robot && other.target != CouplingTarget::Kind::start;
    };
    if (all[c].target == CouplingTarget::Kind::start && std::ranges::any_of(all, outranks))
      continue;
    const auto same = std::ranges::find_if(
        found, [&](std::size_t other) { return is_one_twin(all[c], all[other]); });
    if (same == found.end())
      found.push_back(c);
    else if (all[*same].driven.gripper.empty())
      *same = c;
  }
  return found;
}

ShownCouplingForce pull_of(const SceneModel& scene, SceneCouplings& couplings, std::size_t c,
                           const Snapshot& moment, const Vector3& pull) {
  const SceneCoupling& spec = scene.couplings[c];
  const CouplingEnds ends = couplings.ends(c, moment.x, moment.k);
  ShownCouplingForce shown;
  shown.name = spec.name;
  shown.kind = kind_of_pull(scene, c);
  shown.has_ends = spec.type == CouplingDescription::Type::linear;
  shown.body = static_cast<std::size_t>(spec.spring.body);
  shown.pull_W = pull;
  shown.energy = 0.5 * spec.spring.k * ends.offset.squaredNorm();
  if (shown.has_ends) {
    shown.p_D = moment.k.position(spec.spring.body, spec.spring.p_L);
    shown.p_K = shown.p_D + ends.offset;
    return shown;
  }
  shown.p_D = shown.p_K = moment.k.X_WL[shown.body].p;
  // The axis of a joint of one degree of freedom is z of its body.
  if (spec.measure == SpringSpace::joint)
    shown.pull_W = pull.x() * moment.k.R_WB[shown.body].col(2);
  return shown;
}

}  // namespace

ShownCouplingForce::Kind kind_of_pull(const SceneModel& scene, std::size_t coupling) {
  const SceneCoupling& spec = scene.couplings[coupling];
  const bool along_joint =
      spec.measure == SpringSpace::joint &&
      is_translational(scene.model.joint[static_cast<std::size_t>(spec.spring.body)]);
  return spec.type == CouplingDescription::Type::linear || along_joint
             ? ShownCouplingForce::Kind::force
             : ShownCouplingForce::Kind::couple;
}

std::vector<PairForce> pair_forces(const Snapshot& moment) {
  struct Sum {
    PairForce pair;
    double weight = 0;
  };
  std::map<std::pair<int, int>, Sum> sums;
  for (const ShownContact& contact : moment.contacts) {
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

Snapshot moment_of(const Model<double>& model, const State<double>& x) {
  Snapshot moment(model);
  moment.x = x;
  forward_kinematics(model, x, moment.k);
  moment.kinetic = kinetic_energy(model, x);
  moment.potential = potential_energy(model, x);
  return moment;
}

Snapshot moment_of(const SceneModel& scene, SceneCouplings& couplings, const State<double>& x,
                   const std::vector<Vector3>& pulls) {
  Snapshot moment = moment_of(scene.model, x);
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    const Vector3 pull = c < pulls.size() ? pulls[c] : Vector3(Vector3::Zero());
    moment.pulls.push_back(pull_of(scene, couplings, c, moment, pull));
    moment.elastic += moment.pulls.back().energy;
  }
  for (const std::size_t c : leaders(scene)) {
    const SceneCoupling& spec = scene.couplings[c];
    moment.twins.push_back({spec.robot, couplings.target(c, x.t).k.X_WL});
    if (spec.target == CouplingTarget::Kind::start || spec.target == CouplingTarget::Kind::state)
      continue;
    const HandSample hand = couplings.hand(c).sample(x.t, x.t + 1e-6);
    moment.hands.push_back({hand.theta, hand.button});
  }
  return moment;
}

Vector3 com_of(const Model<double>& model, const Kinematics& k, std::size_t body) {
  const Inertia<double>& I = model.I[body];
  if (!(I.m > 0)) return k.X_WL[body].p;
  return k.X_WL[body].p + k.R_WB[body] * to_eigen(I.h) / I.m;
}

// About the centre of mass c from that about the origin: I_c = I_o - m (c.c 1 - c c^T), c = h / m.
Matrix3 inertia_of(const Model<double>& model, const Kinematics& k, std::size_t body) {
  const Inertia<double>& I = model.I[body];
  Matrix3 I_B;
  for (int column = 0; column < 3; ++column) {
    const Vector3 unit = Vector3::Unit(column);
    I_B.col(column) = to_eigen(I.I * from_eigen(unit));
  }
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
