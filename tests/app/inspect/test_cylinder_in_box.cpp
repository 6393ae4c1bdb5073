// An articulated body as in example 7.1 of RBDA: a box, and inside it a cylinder with rotation
// about x and translation along y. The book was not at hand. The arrangement is as Drake's
// articulated_body_algorithm_test describes that example, with the sizes used there; every number
// below is worked out here, by hand.
//
// All axes along x, y, z, equal centres of mass. Diagonals, angular part first:
//   box       0.4 x 1 x 1 m, 2 kg            I1 = (1/3, 29/150, 29/150, 2, 2, 2)
//   cylinder  r 0.2, length 0.3 m, 4/5 kg    I2 = (2/125, 7/500, 7/500, 4/5, 4/5, 4/5)
//   S = (e1 e5), U = I2 S = (2/125 e1  4/5 e5), D = S^T U = (2/125 0; 0 4/5)
//   Ia = I2 - U D^-1 U^T = (0, 7/500, 7/500, 4/5, 0, 4/5): zero in the joint's directions
//   IA = I1 + Ia = (1/3, 311/1500, 311/1500, 14/5, 2, 14/5): not the inertia of a rigid body
// With the cylinder 1/4 m along y, Ia acts there: X^T Ia X adds m y^2 = 1/20 about x and z, and
//   H = [r]x M = (0 0 1/5; 0 0 0; -1/5 0 0).
#include <doctest/doctest.h>

#include "app/inspect/inspection.h"
#include "solver/dynamics/model_builder.h"

using namespace twinarm;

namespace {

// Two joints in series with a massless carriage between them.
Model<double> cylinder_in_box() {
  ModelBuilder builder;
  builder.set_gravity(Vector3::Zero());
  const Vector3 box(1.0 / 3, 29.0 / 150, 29.0 / 150), cylinder(2.0 / 125, 7.0 / 500, 7.0 / 500);
  builder.add_body("box", 0, "free", JointType::free, {}, Vector3::UnitZ(),
                   {2, Vector3::Zero(), box.asDiagonal()});
  builder.add_body("carriage", 1, "slide", JointType::prismatic, {}, Vector3::UnitY(),
                   {0, Vector3::Zero(), Matrix3::Zero()});
  builder.add_body("cylinder", 2, "turn", JointType::revolute, {}, Vector3::UnitX(),
                   {0.8, Vector3::Zero(), cylinder.asDiagonal()});
  return builder.build();
}

Eigen::MatrixXd value_of(const Inspection& in, std::size_t body, const std::string& name) {
  for (const DisplayedQuantity& shown : shown_quantities(in, 2, body))
    if (shown.quantity.name == name) return shown.value;
  FAIL("no quantity " << name);
  return {};
}

Eigen::MatrixXd diagonal(double a, double b, double c, double d, double e, double f) {
  return (Vector6() << a, b, c, d, e, f).finished().asDiagonal();
}

void check_equal(const Eigen::MatrixXd& found, const Eigen::MatrixXd& wanted) {
  CHECK((found - wanted).lpNorm<Eigen::Infinity>() < 1e-15);
}

}  // namespace

TEST_CASE("cylinder in a box, after RBDA example 7.1: U, D, Ia and IA are the fractions by hand") {
  const Model<double> model = cylinder_in_box();
  const Inspection in(model, State<double>(model), {});
  constexpr std::size_t kBox = 1, kCarriage = 2, kCylinder = 3;
  check_equal(value_of(in, kCylinder, "IA"), diagonal(0.016, 0.014, 0.014, 0.8, 0.8, 0.8));
  check_equal(value_of(in, kCylinder, "U"), 0.016 * Vector6::Unit(0));
  check_equal(value_of(in, kCylinder, "D"), Eigen::MatrixXd::Constant(1, 1, 0.016));
  check_equal(value_of(in, kCylinder, "Ia"), diagonal(0, 0.014, 0.014, 0.8, 0.8, 0.8));
  check_equal(value_of(in, kCarriage, "U"), 0.8 * Vector6::Unit(4));
  check_equal(value_of(in, kCarriage, "D"), Eigen::MatrixXd::Constant(1, 1, 0.8));
  check_equal(value_of(in, kCarriage, "Ia"), diagonal(0, 0.014, 0.014, 0.8, 0, 0.8));
  check_equal(value_of(in, kBox, "IA"), diagonal(1.0 / 3, 311.0 / 1500, 311.0 / 1500, 2.8, 2, 2.8));
}

TEST_CASE("cylinder off the centre of a box: apparent masses along x and z have a lever arm") {
  const Model<double> model = cylinder_in_box();
  State<double> x(model);
  x.q[model.iq[2]] = 0.25;
  x.q[model.iq[3]] = 0.7;  // no effect: the cylinder is round
  const Inspection in(model, x, {});
  Eigen::MatrixXd wanted = diagonal(1.0 / 3 + 0.05, 311.0 / 1500, 311.0 / 1500 + 0.05, 2.8, 2, 2.8);
  wanted(0, 5) = wanted(5, 0) = 0.2;
  wanted(2, 3) = wanted(3, 2) = -0.2;
  check_equal(value_of(in, 1, "IA"), wanted);
}
