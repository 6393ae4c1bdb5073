// A mouse that pulls a body: a spring-damper from a point of the body to a goal in the world, with
// books of its own in the run's ledgers.
//
//   F = k (x_G - x) - b v,   k = m w^2,  b = 2 m w,
// critically damped for the mass m that the body has as felt at the point: m = rank / trace of
// J M^-1 J^T. The spring pulls with `most` at the most: the goal is then as if nearer. In
// semi-implicit steps it is implicit (solver/forces/spring.h), m* = h b + h^2 k, and stable however
// light the body is; with other integrators it is a force like any other.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/lab/run/history.h"
#include "app/run/simulate_input.h"
#include "app/scene/forces/reported_forces.h"
#include "solver/model/model.h"

namespace twinarm {

class MousePull final : public OutsideForce {
 public:
  static constexpr double kOmega = 15;            // [rad/s]
  static constexpr double kLongestStretch = 0.3;  // that the spring pulls with [m]

  // The model must outlive it.
  MousePull(const Model<double>& model, const RunPlan& plan);

  // A pull at a point of a body (link axes) that stands at x. nullopt: no force can move it.
  std::optional<PullInput> grab(const State<double>& x, int body, const Vector3& p_L,
                                const Vector3& goal_W) const;
  void set(const std::optional<PullInput>& pull) { pull_ = pull; }
  const std::optional<PullInput>& input() const { return pull_; }
  const Vector3& force() const { return shown_; }  // on the body, mean of the last step [N]

  void begin_step(const Kinematics&, double, double h) noexcept override { h_ = h; }
  void add_forces(const State<double>&, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  void keep() override { kept_ = reading_; }
  void go_back() noexcept override { reading_ = kept_; }

  std::string name() const override { return "mouse"; }
  void book(double h, std::span<const double> weights, const State<double>& start,
            const std::vector<State<double>>& inner, const State<double>& end) override;
  const std::vector<Given>& given() const override { return given_; }
  void visit_books(Memory& memory) override;

 private:
  struct Reading {  // of the last evaluation
    Vector3 force = Vector3::Zero();
    double m_star = 0;
  };
  Reading read(const Kinematics& k) const;
  void book_step(double h, const State<double>& start, const State<double>& end, Exchange& sum);
  void book_part(double part, const State<double>& x, Exchange& sum);

  const Model<double>& model_;
  bool is_implicit_, drifts_first_;
  double h_ = 0;
  std::optional<PullInput> pull_;
  Reading reading_, kept_;
  Vector3 shown_ = Vector3::Zero();
  std::vector<Given> given_;
  Kinematics k_;
};

}  // namespace twinarm
