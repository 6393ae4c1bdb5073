#include "tests/soak/soak_energy.h"

#include <algorithm>
#include <cmath>

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/world_kinematics.h"

namespace twinarm::soak {

EnergyBooks::EnergyBooks(const SceneModel& scene, SceneCouplings& couplings, Shoves& shoves)
    : scene_(scene),
      couplings_(couplings),
      shoves_(shoves),
      k_(scene.model),
      k_end_(scene.model),
      w_(scene.model),
      still_(scene.model.nv),
      no_forces_(scene.model.parent.size()),
      pushed_(scene.model),
      x_(scene.start),
      between_(scene.start) {}

double EnergyBooks::kinetic(const State<double>& x) {
  kinematics(scene_.model, x, w_);
  return kinetic_energy(scene_.model, x, w_);
}

double EnergyBooks::elastic(const State<double>& x) {
  forward_kinematics(scene_.model, x, k_);
  double sum = 0;
  for (std::size_t c = 0; c < couplings_.size(); ++c)
    sum += 0.5 * couplings_.spec(c).spring.k * couplings_.ends(c, x, k_).offset.squaredNorm();
  return sum;
}

void EnergyBooks::begin(const State<double>& x) {
  x_ = x;
  kinetic_ = kinetic(x);
  potential_ = potential_energy(scene_.model, w_);
  start_ = energy_ = kinetic_ + potential_ + elastic(x);
  scale_ = std::abs(potential_) + kinetic_;
}

// From x_ on, whose k_ is up to date. Centres of free bodies are their origins.
EnergyBooks::Turning EnergyBooks::turned(const State<double>& to, double h) {
  constexpr int kMax = 200;
  const Model<double>& model = scene_.model;
  pushed_.clear();
  shoves_.add_forces(x_, k_, pushed_);
  Turning sum;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    if (model.joint[i] != JointType::free) continue;
    const Eigen::Map<const Vector3> w(x_.qd.data() + model.iv[i]), end(to.qd.data() + model.iv[i]);
    const Sym3<double>& Is = model.I[i].I;
    Matrix3 I;
    I << Is.xx, Is.xy, Is.xz, Is.xy, Is.yy, Is.yz, Is.xz, Is.yz, Is.zz;
    const Matrix3 inverse = I.inverse();
    const Vector3 n = to_eigen(pushed_.f_ext[i].n);
    Vector3 mean = w, last = Vector3::Zero();
    for (int k = 0; k < kMax && mean != last; ++k) {
      last = mean;
      mean = w + 0.5 * h * inverse * (n - last.cross(I * last));
    }
    const Vector3 moment = mean.cross(I * mean);
    sum.work -= h * moment.dot(end);
    sum.more -= h * (w.cross(I * w) - moment).dot(end);
  }
  return sum;
}

void EnergyBooks::add_step(const State<double>& x, const std::vector<double>& v_struck,
                           double apart, double h) {
  // At the old place, with the velocities after impacts, and with the new ones.
  x_.qd = v_struck;
  const double struck = kinetic(x_);
  between_.q = x_.q, between_.qd = x.qd, between_.t = x_.t;
  const double after = kinetic(between_);
  forward_kinematics(scene_.model, x_, k_);
  forward_kinematics(scene_.model, between_, k_end_);
  const double shoved = h * shoves_.power(k_end_);
  double pulled = 0, by_hand = 0;
  for (std::size_t c = 0; c < couplings_.size(); ++c) {
    const CouplingEnds a = couplings_.ends(c, x_, k_), b = couplings_.ends(c, between_, k_end_);
    const Vector3 change = couplings_.m_star(c) * (b.velocity - a.velocity);
    const Vector3 impulse = h * couplings_.force(c) - change;
    pulled += impulse.dot(b.velocity);
    by_hand += impulse.dot(a.target_velocity);
  }
  rnea(scene_.model, x_, still_, no_forces_, w_);
  double bias = 0;
  for (std::size_t i = 0; i < x.qd.size(); ++i) bias += h * w_.tau[i] * x.qd[i];
  const Turning turning = turned(x, h);
  bias += turning.more;
  created_ = std::max(struck - kinetic_, after - struck - shoved - pulled + bias);

  const double before = energy_;
  work_ += shoved + by_hand;
  gone_ += std::abs(shoved) + std::abs(by_hand);
  apart_ += apart;
  x_ = x;
  kinetic_ = kinetic(x);
  potential_ = potential_energy(scene_.model, w_);
  energy_ = kinetic_ + potential_ + elastic(x);
  given_ = energy_ - before - shoved - by_hand - turning.work - apart;
}

}  // namespace twinarm::soak
