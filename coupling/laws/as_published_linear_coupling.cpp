// The linear coupling as published (coupling/laws/as_published.h).
#include "coupling/laws/spring_damper.h"
#include "solver/forces/spring.h"

namespace twinarm {
namespace {

class AsPublishedLinear final : public AsPublished<AsPublishedLinear, Vector3> {
 public:
  AsPublishedLinear(const CouplingSpec& spec, const Model<double>& model, TargetRobot& kvr)
      : AsPublished(spec, model, kvr, spec.options, Vector3::Zero()) {}
  void add_forces(const State<double>&, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    for (std::size_t s = 0; s < springs_.size(); ++s)
      add_point_force(k, springs_[s].body, pose(springs_[s], k), readings_[s].force_W, forces);
  }
  JointSpace joint_space(const Kinematics& k) const override {
    return joint_space_of_points(model_, k, springs_);
  }

  Vector3 pose(const Spring& spring, const Kinematics& k) const {
    return k.position(spring.body, spring.p_L);
  }
  static Vector3 step_between(const Vector3& before, const Vector3& now) { return now - before; }
  void evaluate(std::size_t s, const Kinematics&, const Vector3& p_K, const Vector3& p_D,
                const Vector3& step_K, const Vector3& step_D, double interval) {
    const double by = options_.difference == Difference::per_frame ? 1.0 : interval;
    const Vector3 v_K = step_K / by, v_D = step_D / by;
    SpringState& reading = readings_[s];
    reading.p_K = p_K;
    reading.p_D = p_D;
    reading.force_W = springs_[s].k * (p_K - p_D) - springs_[s].b * (v_D - v_K);
    reading.size = reading.force_W.norm();
  }
};

}  // namespace

CouplingFacts as_published_linear_coupling() {
  return {.name = "published-linear",
          .type = CouplingSpec::Type::linear,
          .printed = true,
          .order = 8,
          .at_point = true,
          .can_hold = true,
          .step_law = StepLaw::printed,
          .make = make_law<AsPublishedLinear>};
}

}  // namespace twinarm
