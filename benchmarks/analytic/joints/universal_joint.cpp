// B8, Hooke's joint between shafts at an angle b: tan(out) = tan(in) / cos b, so that
//   out' / in' = cos b / (cos^2(in) cos^2 b + sin^2(in)),   from cos b to 1 / cos b,
// with the input's pin in the plane of the shafts at in = 0. And a plate of 1 m x 0.6 m, 1 kg, on a
// universal joint at the middle of its short edge: w^2 = m g (1/2) / I about each axis.
#include "benchmarks/analytic/support/smooth_parts.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/loops/loop_closure.h"

namespace twinarm {
namespace {

constexpr double kAngle = 30 * kDegree;

// The input shaft is inclined by b; the output shaft, kept on the world's z by a loop, is its child
// through a universal joint whose axes are x of the input and y of the output.
Model<double> shafts(double angle) {
  const BodyInertia some{1, Vector3::Zero(), 0.1 * Matrix3::Identity()};
  ModelBuilder builder;
  const Matrix3 inclined = Eigen::AngleAxisd(-angle, Vector3::UnitY()).toRotationMatrix();
  const int input = builder.add_body("input", 0, "bearing", JointType::revolute,
                                     {inclined, Vector3::Zero()}, Vector3::UnitZ(), some);
  builder.add_body("output", input, "hooke", JointType::universal, {}, Vector3::UnitX(), some);
  return builder.build();
}

struct Output {
  double angle, ratio;
};
Output output(const Model<double>& model, const State<double>& start, double input) {
  std::vector<LoopClosure> loops(2);
  loops[0] = {"bearing of the output", LoopType::hinge, 2, 0};
  loops[1] = {"input", LoopType::locked, 1, 0};
  loops[1].offset = input;
  State<double> x = start;
  x.q[0] = input;
  x = close_loops(model, loops, std::move(x));
  Kinematics k = kinematics_at(model, x);
  LoopClosures bearing(model, {loops[0]});
  bearing.evaluate(x, k);
  const Eigen::VectorXd rates = min_solution(bearing.J().rightCols(2), -bearing.J().col(0));
  x.qd = {1, rates[0], rates[1]};
  forward_kinematics(model, x, k);
  const Vector3 pin = k.X_WL[2].R.col(1);
  return {std::atan2(-pin.x(), pin.y()), k.w_WL[2].z()};
}

TrajectoryCase hooke() {
  const double c = std::cos(kAngle), in = 30 * kDegree;
  const double C = std::cos(in) * c, S = std::sin(in);
  TrajectoryCase all = evaluation(
      at_rest(shafts(kAngle)),
      {"angle out at 30 degrees in [rad]", "ratio there", "ratio at 0", "ratio at 90 degrees"},
      [](ModelRef model, StateRef x) {
        const Output at_30 = output(model, x, 30 * kDegree);
        return values(at_30.angle, at_30.ratio, output(model, x, 0).ratio,
                      output(model, x, 90 * kDegree).ratio);
      },
      {std::atan(std::tan(in) / c), c / (C * C + S * S), 1 / c, c}, relative_each);
  all.mutant = [](CaseScene& scene) { scene.model = shafts(1.001 * kAngle); };
  return all;
}

TrajectoryCase plate() {
  const Vector3 moments(1. / 12, 1.36 / 12, 0.36 / 12);
  const BodyInertia hanging{1, {0, 0, -0.5}, moments.asDiagonal()};
  const double torque = kGravity / 2;
  return evaluation(at_rest(one_body(JointType::universal, Vector3::UnitX(), hanging)),
                    {"about the normal [rad/s]", "about the edge [rad/s]"}, small_frequencies,
                    {std::sqrt(torque / (1.36 / 12 + 0.25)), std::sqrt(torque * 3)},
                    max_difference);
}

}  // namespace

CaseFamily universal_joint_cases() {
  return {100, {{"B8", 1e-12, hooke()}, {"B8-plate", 1e-6, plate()}}};
}

}  // namespace twinarm
