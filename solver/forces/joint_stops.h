// Compliant end stops of joints with one degree of freedom: a spring-damper on the coordinate acts
// that is beyond the limit at the start of a step. Implicit (armature + h b + h^2 k): stable.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/forces/force_source.h"
#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {

class JointStops final : public SpringSource {
 public:
  struct Stop {
    int body = 0;  // child of the joint
    double lower = 0, upper = 0;
    double k = 0, b = 0;  // [N m/rad, N m s/rad; N/m, N s/m]

    // Limit minus q beyond the limit; 0 between the limits.
    double way_back(double q) const { return q < lower ? lower - q : q > upper ? upper - q : 0; }
  };
  // Throws InputError for negative gains and joints without exactly one degree of freedom.
  JointStops(const std::string& name, const Model<double>& model, std::vector<Stop> stops)
      : model_(model), stops_(std::move(stops)) {
    readings_.resize(stops_.size());
    DiagnosticList faults;
    for (const Stop& stop : stops_) {
      const std::string where = "coupling '" + name + "'";
      if (!(stop.k >= 0 && stop.b >= 0))
        faults.add(where,
                   "stop has k = " + short_number_text(stop.k) +
                       ", b = " + short_number_text(stop.b) + ", must not be negative",
                   "give gains of at least 0", "coupling.gain");
      const auto i = static_cast<std::size_t>(stop.body);
      if (stop.body <= 0 || stop.body >= model.body_count())
        faults.add(where,
                   "link index of a stop is " + std::to_string(stop.body) + ", of 1 to " +
                       std::to_string(model.body_count() - 1),
                   "name a link of the robot", "coupling.link");
      else if (model.dofs(i) != 1)
        faults.add(
            where + ", joint '" + model.joint_name[i] + "'",
            "the joint has " + std::to_string(model.dofs(i)) + " degrees of freedom, not one",
            "name links on revolute, prismatic or screw joints", "coupling.degrees-of-freedom");
    }
    faults.check();
  }

  void begin_step(const Kinematics&, double, double h) noexcept override { h_ = h; }
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    for (std::size_t s = 0; s < stops_.size(); ++s) {
      const Stop& stop = stops_[s];
      const auto i = static_cast<std::size_t>(stop.body);
      const double q = x.q[model_.iq[i]], qd = x.qd[model_.iv[i]];
      const double limit = q < stop.lower ? stop.lower : stop.upper;
      SpringState& reading = readings_[s];
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

 private:
  const Model<double>& model_;
  std::vector<Stop> stops_;
  double h_ = 0;  // step [s]
};

}  // namespace twinarm
