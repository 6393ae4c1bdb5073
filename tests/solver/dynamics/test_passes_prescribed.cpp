// A prescribed joint is equivalent to a free joint with the force of inverse dynamics.
#include "tests/solver/dynamics/every_scalar.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// The same tree with prescribed or free base.
struct DrivenAndFree {
  Model<double> driven, free;
  State<double> x_driven, x_free;
  std::vector<double> qdd_base;  // of the free joint

  explicit DrivenAndFree(Random& random) {
    std::vector<TreeBody> bodies = random_bodies(random, random.integer(2, 9),
                                                 {all_joint_types.begin(), all_joint_types.end()});
    for (std::size_t i = 1; i < bodies.size(); ++i) {
      bodies[i].parent = std::max(bodies[i].parent, 1);
      bodies[i].properties.armature = random.uniform(0, 0.5);
    }
    bodies[0].type = JointType::prescribed;
    driven = build(bodies);
    bodies[0].type = JointType::free;
    free = build(bodies);
    x_driven = random_state(random, driven);
    x_free = State<double>(free);
    std::copy(x_driven.q.begin() + 7, x_driven.q.end(), x_free.q.begin() + 7);
    std::copy(x_driven.qd.begin(), x_driven.qd.end(), x_free.qd.begin() + 6);
    std::copy_n(x_driven.q.begin(), 7, x_free.q.begin());
    x_free.prescribed.assign(x_driven.prescribed.begin() + 12, x_driven.prescribed.end());

    // Prescribed: velocity and its derivative in the child's axes. Free: the linear part in the
    // parent's, v_P = R v, v_P' = R (v' + w x v).
    const double *q = x_driven.q.data(), *g = x_driven.prescribed.data();
    const Matrix3 R = Eigen::Quaterniond(q[3], q[4], q[5], q[6]).toRotationMatrix();
    const Vector3 w(g[0], g[1], g[2]), v(g[3], g[4], g[5]), dw(g[6], g[7], g[8]),
        dv(g[9], g[10], g[11]);
    const Vector3 v_P = R * v, dv_P = R * (dv + w.cross(v));
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      x_free.qd[at] = w[k];
      x_free.qd[at + 3] = v_P[k];
    }
    qdd_base = {dw.x(), dw.y(), dw.z(), dv_P.x(), dv_P.y(), dv_P.z()};
  }
};

}  // namespace

TEST_CASE("a prescribed base is equivalent to a free base that is forced to the same motion") {
  Random random(1);
  for (int n = 0; n < 100; ++n) {
    const DrivenAndFree both(random);
    if (both.driven.nv == 0) continue;
    const Forces<double> forces = random_forces(random, both.driven);
    Workspace<double> w(both.driven), w_free(both.free);
    aba(both.driven, both.x_driven, forces, w);
    std::vector<double> qdd = both.qdd_base;
    qdd.insert(qdd.end(), w.qdd.begin(), w.qdd.end());
    rnea(both.free, both.x_free, qdd, forces.f_ext, w_free);
    double scale = 1;
    for (const double tau : w_free.tau) scale = std::max(scale, std::abs(tau));
    for (std::size_t k = 0; k < both.driven.nv; ++k)
      CHECK(std::abs(w_free.tau[6 + k] - forces.tau[k]) < 1e-12 * scale);
    // The free base with that joint force has the same motion.
    Forces<double> forced(both.free);
    forced.f_ext = forces.f_ext;
    forced.tau = w_free.tau;
    aba(both.free, both.x_free, forced, w_free);
    for (std::size_t k = 0; k < qdd.size(); ++k)
      CHECK(w_free.qdd[k] == doctest::Approx(qdd[k]).epsilon(1e-8));
    // The force of the prescribed joint is that of the free joint.
    rnea(both.driven, both.x_driven, w.qdd, forces.f_ext, w);
    rnea(both.free, both.x_free, qdd, forces.f_ext, w_free);
    const Force<double> difference = w.f[1] - w_free.f[1];
    CHECK(std::sqrt(dot(difference.n, difference.n)) < 1e-11 * scale);
    CHECK(std::sqrt(dot(difference.f, difference.f)) < 1e-11 * scale);
  }
}
