#include "tests/scene/soak/soak_energy.h"

#include <cmath>

#include "solver/dynamics.h"
#include "solver/world.h"

namespace twinarm::soak {

EnergyBooks::EnergyBooks(const SceneModel& scene, SceneCouplings& couplings, const Shoves& shoves)
    : scene_(scene),
      couplings_(couplings),
      shoves_(shoves),
      k_(scene.model),
      k_end_(scene.model),
      w_(scene.model),
      still_(scene.model.nv),
      no_forces_(scene.model.parent.size()),
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

void EnergyBooks::add_step(const State<double>& x, double h) {
  // At the old place with the new velocities.
  between_.q = x_.q, between_.qd = x.qd, between_.t = x_.t;
  const double after = kinetic(between_);
  forward_kinematics(scene_.model, x_, k_);
  forward_kinematics(scene_.model, between_, k_end_);
  const double shoved = h * shoves_.power(k_end_);
  double pulled = 0, by_hand = 0;
  for (std::size_t c = 0; c < couplings_.size(); ++c) {
    const CouplingEnds a = couplings_.ends(c, x_, k_), b = couplings_.ends(c, between_, k_end_);
    const Vector3 change = couplings_.m_star(c) * (b.velocity - a.velocity);
    const Vector3 pull = h * couplings_.pull(c) - change;
    pulled += pull.dot(b.velocity);
    by_hand += pull.dot(a.target_velocity);
  }
  rnea(scene_.model, x_, still_, no_forces_, w_);
  double bias = 0;
  for (std::size_t i = 0; i < x.qd.size(); ++i) bias += h * w_.tau[i] * x.qd[i];
  created_ = after - kinetic_ - shoved - pulled + bias;

  work_ += shoved + by_hand;
  gone_ += std::abs(shoved) + std::abs(by_hand);
  x_ = x;
  kinetic_ = kinetic(x);
  potential_ = potential_energy(scene_.model, w_);
  energy_ = kinetic_ + potential_ + elastic(x);
}

}  // namespace twinarm::soak
