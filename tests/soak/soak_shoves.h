// Shoves at random: a force at a link's origin and a couple, in world axes, for some milliseconds.
#pragma once

#include <vector>

#include "solver/forces/force_source.h"
#include "tests/soak/soak_scenes.h"

namespace twinarm::soak {

class Shoves final : public ForceSource {
 public:
  // Of bodies with these masses; 0: never shoved. Mostly up to `push` m/s, each 20th five times so.
  Shoves(std::vector<double> masses, double push, Chance chance)
      : masses_(std::move(masses)), push_(push), chance_(chance) {}

  void begin_step(const Kinematics&, double t, double) noexcept override {
    acts_ = acts_ && t < end_;
    if (acts_ || t < next_) return;
    do body_ = chance_.below(masses_.size());
    while (masses_[body_] == 0);
    const double lasting = chance_.uniform(0.002, 0.05), strong = chance_.below(20) == 0 ? 5 : 1;
    const double force = strong * push_ * masses_[body_] / lasting;
    force_W_ = force * chance_.uniform(0, 1) * chance_.direction();
    couple_W_ = force * 0.003 * chance_.uniform(0, 1) * chance_.direction();  // as if off by 3 mm
    acts_ = true, end_ = t + lasting, next_ = t + chance_.uniform(0.05, 1);
  }
  void add_forces(const State<double>&, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    if (!acts_) return;
    const Matrix3 R_BW = k.R_WB[body_].transpose();
    forces.f_ext[body_] += Force<double>{from_eigen(R_BW * couple_W_), from_eigen(R_BW * force_W_)};
  }
  double power(const Kinematics& k) const {  // [W]
    return acts_ ? force_W_.dot(k.v_WLo[body_]) + couple_W_.dot(k.w_WL[body_]) : 0;
  }

 private:
  std::vector<double> masses_;  // by body [kg]
  double push_;
  Chance chance_;
  bool acts_ = false;
  double end_ = 0, next_ = 0.2;
  std::size_t body_ = 0;
  Vector3 force_W_ = Vector3::Zero(), couple_W_ = Vector3::Zero();
};

}  // namespace twinarm::soak
