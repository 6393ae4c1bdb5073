// End stops of one-dof joints: where a joint of the DVR passes a limit, a stiff spring-damper on
// its coordinate pushes it back. Implicit (an armature), so it is stable at any stiffness.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "coupling/laws/coupling.h"

namespace twinarm {

class JointStops final : public Coupling {
 public:
  struct Stop {
    int body = 0;  // that the joint carries
    double lower = 0, upper = 0;
    double k = 0, b = 0;  // at the stop [N m/rad, N m s/rad], or [N/m, N s/m] for a prismatic joint

    // How far the limit lies from a coordinate that has passed it; 0 between the limits.
    double way_back(double q) const { return q < lower ? lower - q : q > upper ? upper - q : 0; }
  };
  // Of the KVR nothing is asked.
  JointStops(std::string name, const Model<double>& model, KinematicRobot& kvr,
             std::vector<Stop> stops)
      : Coupling(std::move(name), model, kvr, springs_of(stops)), stops_(std::move(stops)) {
    check_one_dof();
  }

  void begin_step(const Kinematics&, double, double h) noexcept override { h_ = h; }
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    for (std::size_t s = 0; s < stops_.size(); ++s) {
      const Stop& stop = stops_[s];
      const auto i = static_cast<std::size_t>(stop.body);
      const double q = x.q[model_.iq[i]], qd = x.qd[model_.iv[i]];
      const double limit = q < stop.lower ? stop.lower : stop.upper;
      SpringReading& reading = readings_[s];
      reading.p_K = reading.p_D = k.X_WL[i].p;
      reading.size = reading.m_star = 0;
      if (q >= stop.lower && q <= stop.upper) continue;
      reading.size = stop.k * (limit - q - h_ * qd) - stop.b * qd;
      forces.tau[model_.iv[i]] += reading.size;
      reading.m_star = h_ * stop.b + h_ * h_ * stop.k;
      forces.armature[model_.iv[i]] += reading.m_star;
    }
  }
  bool needs_semi_implicit() const override { return true; }
  // Between the limits there is no force.
  JointSpace joint_space(const Kinematics&) const override { return JointSpace(model_.nv); }

 private:
  static std::vector<Spring> springs_of(const std::vector<Stop>& stops) {
    std::vector<Spring> springs;
    for (const Stop& stop : stops)
      springs.push_back({"", stop.body, Vector3::Zero(), stop.k, stop.b});
    return springs;
  }
  std::vector<Stop> stops_;
};

}  // namespace twinarm
