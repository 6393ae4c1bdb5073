// Scalars of the algorithms agree with one another.
#include <cmath>
#include <cstring>

#include "tests/solver/dynamics/every_scalar.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// Of |exact|, between neighbours of double.
double ulps(double got, double exact) {
  if (std::isnan(got) && std::isnan(exact)) return 0;
  const double size = std::abs(exact);
  return std::abs(got - exact) / (std::nextafter(size, HUGE_VAL) - size);
}
bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}
// Angles in [-limit, limit], and those about multiples of pi/2, where the reduction cancels most.
std::vector<double> angles(double limit) {
  Random random(1);
  std::vector<double> all{0.0, -0.0, 1e-300, -5e-324, limit, -limit};
  for (int n = 0; n < 200000; ++n) all.push_back(random.uniform(-limit, limit));
  for (int n = 0; n < 2000; ++n) all.push_back(std::pow(10, random.uniform(-12, 2)));
  for (int quarter = -127; quarter <= 127; ++quarter)
    for (int step = -50; step <= 50; ++step) {
      const double x = quarter * 1.57079632679489661923 * (1 + step * 2.2e-16);
      if (std::abs(x) <= limit) all.push_back(x);
    }
  return all;
}

}  // namespace

TEST_CASE("sin_cos is within 1.6 ulp of the true sine and cosine for |x| <= 200") {
  double sine = 0, cosine = 0;
  for (const double x : angles(200)) {
    const SinCos<double> got = sin_cos(x);
    const auto exact = static_cast<long double>(x);
    const auto ulp = [](double g, long double e) {
      const auto size = static_cast<double>(std::abs(e));
      return static_cast<double>(std::abs(g - e) / (std::nextafter(size, HUGE_VAL) - size));
    };
    sine = std::max(sine, ulp(got.sin, std::sin(exact)));
    cosine = std::max(cosine, ulp(got.cos, std::cos(exact)));
  }
  MESSAGE("largest error: sine " << sine << " ulp, cosine " << cosine << " ulp");
  CHECK(sine <= 1.6);
  CHECK(cosine <= 1.6);
}

TEST_CASE("sin_cos of large, infinite and NaN arguments is that of libm") {
  for (const double x : {200.1, -1e3, 1e9, 1e300, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    const SinCos<double> got = sin_cos(x);
    CHECK(ulps(got.sin, std::sin(x)) == 0);
    CHECK(ulps(got.cos, std::cos(x)) == 0);
  }
}

TEST_CASE_TEMPLATE("sin_cos of lanes: each lane is independent of the others", S, Batch<4>,
                   Batch<8>) {
  Random random(2);
  const double odd_ones[] = {201, -1e6, 1e300, HUGE_VAL, -HUGE_VAL, std::nan("")};
  for (int n = 0; n < 2000; ++n) {
    S x;
    for (int lane = 0; lane < Scalar<S>::lanes; ++lane) x.set(lane, random.uniform(-200, 200));
    if (n % 2) x.set(n % Scalar<S>::lanes, odd_ones[n % 6]);
    const SinCos<S> got = sin_cos(x);
    for (int lane = 0; lane < Scalar<S>::lanes; ++lane) {
      const SinCos<double> alone = sin_cos(x[lane]);
      if (std::isnan(alone.sin)) {
        CHECK((std::isnan(got.sin[lane]) && std::isnan(got.cos[lane])));
        continue;
      }
      CHECK(same_bits(got.sin[lane], alone.sin));
      CHECK(same_bits(got.cos[lane], alone.cos));
    }
  }
}

TEST_CASE_TEMPLATE("lanes add, multiply, divide, compare and select as doubles", S, Batch<4>,
                   Batch<8>) {
  Random random(3);
  for (int n = 0; n < 100; ++n) {
    S a, b;
    for (int k = 0; k < Scalar<S>::lanes; ++k) {
      a.set(k, random.uniform(-2, 2));
      b.set(k, random.uniform(-2, 2));
    }
    const S sum = a + b, difference = a - b, product = a * b, quotient = a / b, minus = -a;
    const S root = sqrt(a * a), smaller = select(a < b, a, b);
    for (int k = 0; k < Scalar<S>::lanes; ++k) {
      CHECK(sum[k] == a[k] + b[k]);
      CHECK(difference[k] == a[k] - b[k]);
      CHECK(product[k] == a[k] * b[k]);
      CHECK(quotient[k] == a[k] / b[k]);
      CHECK(minus[k] == -a[k]);
      CHECK(root[k] == std::sqrt(a[k] * a[k]));
      CHECK(smaller[k] == std::min(a[k], b[k]));
    }
  }
  S one_lane(0);
  CHECK_FALSE(is_nonzero(one_lane));
  one_lane.set(Scalar<S>::lanes - 1, 1e-300);
  CHECK(is_nonzero(one_lane));
}

TEST_CASE("dual numbers differentiate every operation") {
  const double x = 0.7, y = -1.3;
  Dual<8> a(x), b(y), zero(0);
  a.d[2] = b.d[5] = zero.d[1] = 1;
  const auto check = [](const Dual<8>& f, double value, double by_x, double by_y) {
    CHECK(f.value == doctest::Approx(value).epsilon(1e-15));
    for (int k = 0; k < 8; ++k)
      CHECK(f.d[k] == doctest::Approx(k == 2 ? by_x : k == 5 ? by_y : 0).epsilon(1e-15));
  };
  check(a + b, x + y, 1, 1);
  check(a - b, x - y, 1, -1);
  check(a * b, x * y, y, x);
  check(a / b, x / y, 1 / y, -x / (y * y));
  check(-a, -x, -1, 0);
  check(sqrt(a), std::sqrt(x), 0.5 / std::sqrt(x), 0);
  check(sin_cos(a).sin, std::sin(x), std::cos(x), 0);
  check(sin_cos(a).cos, std::cos(x), -std::sin(x), 0);
  check(select(a < b, a, b), y, 0, 1);
  CHECK(is_nonzero(zero));
  CHECK_FALSE(is_nonzero(Dual<8>(0)));
}

TEST_CASE_TEMPLATE("every scalar and level agrees with double at the generic level", S,
                   TWINARM_SCALARS) {
  Random random(4);
  double worst = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 10; ++n) {
      Packed<S> p(random, random_tree(random, random.integer(1, 8), types));
      const bool geared =
          random.integer(0, 1) ==
          1;  // in all lanes or none: revolute joints without armature use another formula
      for (Forces<double>& f : p.forces)
        for (std::size_t i = 1; i < p.model.parent.size(); ++i) {
          for (std::size_t k = p.model.iv[i]; k < p.model.iv[i] + p.model.dofs(i) && geared; ++k)
            f.armature[k] = random.uniform(0.1, 1);
          f.add_inertia(i, ArticulatedInertia<double>(p.model.I[i]));
        }
      p.pack();
      for (const Isa isa : levels_of<S>()) {
        Workspace<S> w(p.model_S);
        passes<S>(isa).aba(p.model_S, p.x_S, p.forces_S, w);
        for (int lane = 0; lane < Scalar<S>::lanes; ++lane) {
          const auto k = static_cast<std::size_t>(lane);
          Workspace<double> alone(p.model);
          passes<double>(Isa::generic).aba(p.model, p.x[k], p.forces[k], alone);
          const Eigen::VectorXd got = lane_of(w.qdd, lane), expected = lane_of(alone.qdd, 0);
          if (p.model.nv == 0) continue;
          worst = std::max(worst, (got - expected).norm() / expected.norm());
          if (isa == Isa::generic && Scalar<S>::lanes > 1) CHECK(got == expected);  // bit-identical
        }
      }
    }
  MESSAGE("largest relative difference of qdd = " << worst);
  CHECK(worst <= 1e-11);
}

TEST_CASE_TEMPLATE("a large or non-finite lane leaves the others bit-identical", S, Batch<4>,
                   Batch<8>) {
  Random random(5);
  const double odd_ones[] = {250, -3e5, HUGE_VAL, std::nan("")};
  for (int n = 0; n < 200; ++n) {
    Packed<S> p(random, random_tree(random, random.integer(2, 8), kAllJoints));
    if (p.model.nv == 0) continue;
    const int odd = random.integer(0, Scalar<S>::lanes - 1);
    for (const Isa isa : levels_of<S>()) {
      Workspace<S> before(p.model_S), after(p.model_S);
      passes<S>(isa).aba(p.model_S, p.x_S, p.forces_S, before);
      Packed<S> spoilt = p;
      for (S& q : spoilt.x_S.q) q.set(odd, odd_ones[n % 4]);
      passes<S>(isa).aba(spoilt.model_S, spoilt.x_S, spoilt.forces_S, after);
      for (int lane = 0; lane < Scalar<S>::lanes; ++lane)
        if (lane != odd) CHECK(lane_of(after.qdd, lane) == lane_of(before.qdd, lane));
    }
  }
}

TEST_CASE("revolute joints after many turns accelerate as at the same angle near zero") {
  Random random(7);
  for (int n = 0; n < 100; ++n) {
    const Model<double> model = random_tree(random, 8, {JointType::revolute});
    State<double> far(model);
    for (double& q : far.q) q = random.uniform(-1e12, 1e12);
    for (double& qd : far.qd) qd = random.uniform(-1, 1);
    State<double> near = far;
    for (double& q : near.q) q = std::atan2(std::sin(q), std::cos(q));
    const Forces<double> forces(model);
    for (const Isa isa : levels_of<double>()) {
      Workspace<double> here(model), there(model);
      passes<double>(isa).aba(model, near, forces, here);
      passes<double>(isa).aba(model, far, forces, there);
      const Eigen::VectorXd expected = lane_of(here.qdd, 0);
      CHECK((lane_of(there.qdd, 0) - expected).norm() <= 1e-12 * expected.norm());
    }
  }
}

TEST_CASE("the instruction-set level can be limited, and is supported by the processor") {
  CHECK(std::string(name_of(Isa::generic)) == "generic");
  CHECK(std::string(name_of(Isa::v3)) == "v3");
  CHECK(std::string(name_of(Isa::v4)) == "v4");
  CHECK(&passes<double>() == &passes<double>(best_isa()));
  CHECK(&passes<Dual<8>>() == &passes<Dual<8>>(best_isa()));
}

TEST_CASE("a model in another scalar is the same model") {
  Random random(6);
  std::vector<TreeBody> bodies = uneven_bodies(random, 12, kAllJoints);
  for (TreeBody& b : bodies) {
    b.properties.damping = random.uniform(0, 1);
    b.properties.coulomb_plus = random.uniform(0, 1);
    b.properties.coulomb_minus = random.uniform(0, 1);
  }
  const Model<double> model = build(bodies);
  const auto there = convert<Batch<4>>(model);
  CHECK(there.body_name == model.body_name);
  CHECK(there.joint_name == model.joint_name);
  CHECK(there.parent == model.parent);
  CHECK(there.joint == model.joint);
  CHECK(there.iq == model.iq);
  CHECK(there.iv == model.iv);
  CHECK(there.nq == model.nq);
  CHECK(there.nv == model.nv);
  for (int lane = 0; lane < 4; ++lane) {
    CHECK(lane_of(there.pitch, lane) == lane_of(model.pitch, 0));
    CHECK(lane_of(there.armature, lane) == lane_of(model.armature, 0));
    CHECK(lane_of(there.damping, lane) == lane_of(model.damping, 0));
    CHECK(lane_of(there.coulomb_plus, lane) == lane_of(model.coulomb_plus, 0));
    CHECK(lane_of(there.coulomb_minus, lane) == lane_of(model.coulomb_minus, 0));
    CHECK(there.gravity.z[lane] == model.gravity.z);
    CHECK(there.R_BL[3].r1.z[lane] == model.R_BL[3].r1.z);
  }
  const State<double> x = random_state(random, model);
  const auto x_there = convert<Batch<4>>(x);
  CHECK(lane_of(x_there.q, 3) == lane_of(x.q, 0));
  CHECK(lane_of(x_there.qd, 3) == lane_of(x.qd, 0));
}
