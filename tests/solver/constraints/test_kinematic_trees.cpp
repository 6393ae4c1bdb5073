#include "solver/constraints/kinematic_trees.h"

#include <doctest/doctest.h>

#include "solver/dynamics/dynamics.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

TEST_CASE("constraints on a robot of more than 4000 joints are refused before memory is taken") {
  ModelBuilder builder;
  for (int k = 0; k < 4001; ++k)
    builder.add_body("b" + std::to_string(k), k, "j" + std::to_string(k), JointType::revolute,
                     Pose{}, Vector3::UnitX(), {1, Vector3::Zero(), Matrix3::Identity()});
  const Model<double> model = builder.build();
  KinematicTrees trees(model);
  ImpulseProblem problem;
  trees.add_to(problem);
  Workspace<double> w(model);
  CHECK_THROWS_WITH_AS(trees.set_mass_matrix(problem, nullptr, w), doctest::Contains("too many"),
                       InputError);
}

TEST_CASE("blocks of the trees are the mass matrix, rows are the Jacobians") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const std::vector<JointType> types(all_joint_types.begin(), all_joint_types.end());
    const Model<double> model = random_tree(random, 2 + static_cast<int>(seed) % 9, types);
    const State<double> x = random_state(random, model);
    Workspace<double> w(model);
    const Eigen::MatrixXd M = mass_matrix(model, x);
    kinematics(model, x, w);
    KinematicTrees trees(model);
    ImpulseProblem problem;
    trees.add_to(problem);
    trees.set_mass_matrix(problem, nullptr, w);
    for (std::size_t a = 0; a < model.nv; ++a)
      for (std::size_t b = 0; b < model.nv; ++b) {
        const int t = trees.tree_of_dof(a);
        const auto n = static_cast<std::size_t>(problem.size(t));
        const auto row = static_cast<Eigen::Index>(a), column = static_cast<Eigen::Index>(b);
        const double entry = t == trees.tree_of_dof(b)
                                 ? problem.M(t)[trees.index_in_tree(a) * n + trees.index_in_tree(b)]
                                 : 0;
        CHECK(entry == doctest::Approx(M(row, column)).epsilon(1e-12).scale(1));
      }
    Kinematics k(model);
    forward_kinematics(model, x, k);
    for (int body = 1; body < model.body_count(); ++body) {
      const int t = trees.tree_of(body);
      if (t == ImpulseConstraint::no_tree) continue;
      const auto n = static_cast<std::size_t>(problem.size(t));
      std::vector<double> J(3 * n);
      const Vector3 p(0.3, -0.2, 0.5);
      trees.add_point_rows(k, body, p, Matrix3::Identity(), 3, 1, J.data());
      const Eigen::Matrix3Xd expected = point_jacobian(model, k, body, p);
      for (std::size_t dof = 0; dof < model.nv; ++dof)
        for (int r = 0; r < 3; ++r) {
          const double entry = trees.tree_of_dof(dof) == t
                                   ? J[static_cast<std::size_t>(r) * n + trees.index_in_tree(dof)]
                                   : 0;
          CHECK(entry == doctest::Approx(expected(r, static_cast<int>(dof))).scale(1));
        }
    }
  }
}
