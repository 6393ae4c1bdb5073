// End stops of one-dof joints: where a joint of the DVR passes a limit, a stiff spring-damper on
// its coordinate pushes it back. Implicit (an armature), so it is stable at any stiffness.
#pragma once

#include <vector>

#include "solver/force_source.h"

namespace twinarm {

class JointStops final : public ForceSource {
 public:
  struct Stop {
    int body = 0;  // that the joint carries
    double lower = 0, upper = 0;
    double k = 0, b = 0;  // at the stop [N m/rad, N m s/rad], or [N/m, N s/m] for a prismatic joint
  };
  JointStops(const Model<double>& model, std::vector<Stop> stops)
      : model_(model), stops_(std::move(stops)) {}

  void begin_step(const Kinematics&, double, double h) noexcept override { h_ = h; }
  void add_forces(const State<double>& x, const Kinematics&,
                  Forces<double>& forces) noexcept override {
    for (const Stop& stop : stops_) {
      const auto i = static_cast<std::size_t>(stop.body);
      const double q = x.q[model_.iq[i]], qd = x.qd[model_.iv[i]];
      const double limit = q < stop.lower ? stop.lower : stop.upper;
      if (q >= stop.lower && q <= stop.upper) continue;
      forces.tau[model_.iv[i]] += stop.k * (limit - q - h_ * qd) - stop.b * qd;
      forces.armature[model_.iv[i]] += h_ * stop.b + h_ * h_ * stop.k;
    }
  }
  bool needs_semi_implicit() const override { return true; }

 private:
  const Model<double>& model_;
  std::vector<Stop> stops_;
  double h_ = 0;
};

}  // namespace twinarm
