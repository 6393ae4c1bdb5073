// MuJoCo weld: the law a = (1 - d) a_0 + d a_ref, tracking error, deflection, energy; and
// trajectories computed by MuJoCo.
#include <doctest/doctest.h>

#include <cmath>

#include "coupling/laws/mujoco_weld.h"
#include "solver/dynamics/energy_momentum.h"
#include "tests/coupling/analysis/laws.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

CouplingSpec weld(std::vector<Spring> springs, const SolrefParameters& reference,
                  Discretization discretization = Discretization::explicit_) {
  CouplingSpec spec;
  spec.type = CouplingSpec::Type::weld;
  spec.reference = reference;
  spec.discretization = discretization;
  spec.springs = std::move(springs);
  return spec;
}

// Point only: no torque.
Spring point_alone(Spring spring) {
  spring.k_rotational = spring.b_rotational = 0;
  return spring;
}

}  // namespace

TEST_CASE("weld: on a prismatic joint a step has a = (1 - d) a_0 + d a_ref, to 1e-12") {
  const double h = 1e-3, m = 0.7;
  const SolrefParameters reference{0.05, 0.8, 0.9};
  const double d = 0.9, b_ref = 2 / (d * 0.05), k_ref = 1 / (d * 0.05 * 0.05 * 0.8 * 0.8);
  const Model<double> model = one_joint(JointType::prismatic, m);
  // A second spring, for a non-zero a_0.
  const double push = 5;
  SteadyHand hand;
  hand.angle[0] = 0.4;
  hand.rate[0] = -0.6;
  const State<double> start = state_of(model, {-0.3}, {0.8});
  // Along the joint only: a third of the trace is 1/(3 m), MuJoCo's mean.
  const Spring spring = weld_spring("weld", model, start, 1, Vector3::Zero(), reference);
  CHECK(spring.b / b_ref == doctest::Approx(d / (1 - d) * 3 * m).epsilon(1e-12));
  CHECK(spring.k / spring.b == doctest::Approx(k_ref / b_ref).epsilon(1e-12));
  CHECK(spring.k_rotational == 0);  // no rotation

  // With m_0 = m the law is that of the documentation.
  const Spring alone{"weld", 1, Vector3::Zero(), d / (1 - d) * m * k_ref, d / (1 - d) * m * b_ref};
  class Push final : public ForceSource {
   public:
    explicit Push(double f) : f_(f) {}
    void add_forces(const State<double>&, const Kinematics&,
                    Forces<double>& forces) noexcept override {
      forces.tau[0] += f_;
    }

   private:
    double f_;
  } pusher(push);
  Coupled system(model, hand, {"joint1"}, weld({alone}, reference), start);
  system.simulation.add(pusher);
  double x = -0.3, v = 0.8, worst = 0;
  for (int n = 0; n < 300; ++n) {
    const double target = 0.4 - 0.6 * h * n;
    const double a = (1 - d) * push / m + d * (-b_ref * v - k_ref * (x - target));
    v += h * a;
    x += h * v;
    system.simulation.step(h);
    worst = std::max(worst, std::abs(system.simulation.state().q[0] - x));
  }
  CHECK(worst < 1e-12);
}

TEST_CASE("weld: the error behind a target at speed V is 2 V T z^2, prismatic and revolute") {
  for (const JointType joint : {JointType::prismatic, JointType::revolute})
    for (const double z : {1.0, 0.6})
      for (const Discretization discretization :
           {Discretization::explicit_, Discretization::semi_implicit, Discretization::implicit}) {
        const double T = 0.03, V = 1.7, h = 1e-3;
        const Model<double> model = one_joint(joint, 0.7);
        SteadyHand hand;
        hand.rate[0] = V;
        const State<double> start = state_of(model, {0}, {0});
        const SolrefParameters reference{T, z, 0.95};
        const Spring spring = weld_spring("weld", model, start, 1, Vector3::Zero(), reference);
        Coupled system(model, hand, {"joint1"}, weld({spring}, reference, discretization), start);
        for (int n = 0; n < 1000; ++n) system.simulation.step(h);
        const double lag = V * 1.0 - system.simulation.state().q[0];
        CAPTURE(z);
        // Implicit: spring with target and link one step ahead.
        CHECK(lag == doctest::Approx(2 * V * T * z * z).epsilon(1e-9));
      }
}

TEST_CASE("weld: its added inertia has no weight, and other forces act with the factor 1 - d") {
  // A revolute joint about y with its mass m at r, held at the mass: m_0 counts once, k_ref r_ =
  // (1-d)/d a_0 at rest, a_0 = g cos(angle) along the circle.
  const double m = 2, r = 0.5, g = 9.81;
  ModelBuilder builder;
  builder.add_body("bob", 0, "joint1", JointType::revolute, {}, Vector3::UnitY(),
                   {m, {r, 0, 0}, 1e-12 * Matrix3::Identity()});
  const Model<double> model = builder.build();
  for (const double d : {0.5, 0.9, 0.99}) {
    const SolrefParameters reference{0.05, 1, d};
    const double part = d / (1 - d) * m;  // m_0 = m: all of the mass moves with the point
    const Spring spring{
        "weld", 1, {r, 0, 0}, part * reference.stiffness(), part * reference.damping()};
    Coupled system(model, {}, {"joint1"}, weld({spring}, reference), state_of(model, {0}, {0}));
    for (int n = 0; n < 3000; ++n) system.simulation.step(1e-3);
    // k r^2 sin(q) = m g r cos(q)
    const double angle = std::atan(m * g / (spring.k * r));
    CHECK(system.simulation.state().q[0] == doctest::Approx(angle).epsilon(1e-9));
    CHECK(m * g / spring.k == doctest::Approx((1 - d) * g * 0.05 * 0.05).epsilon(1e-12));
  }
}

TEST_CASE("weld: with the added inertia's energy, a chain about a KVR at rest only loses energy") {
  Random random(31);
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Model<double> model = chain_of_three(seed);
    const SolrefParameters reference{0.1, 0.9, 0.9};
    const Vector3 q = random.vector(1), qd = random.vector(3);
    const State<double> start = three_state(model, q, qd);
    const Spring spring = weld_spring("weld", model, start, 3, {0.1, 0.2, 0}, reference);
    Coupled system(model, hand_at(q), kThreeJoints, weld({spring}, reference), start);
    const double b_ref = reference.damping(), h = 2e-5;
    const auto energy = [&] {  // T + m_R v^2/2 + k e^2/2, and the torsional ones
      const Kinematics& D = system.simulation.kinematics();
      const Kinematics& K = system.kvr.start().k;
      const Vector3 p = D.position(3, spring.p_L);
      const Eigen::AngleAxisd turn(K.X_WL[3].R * D.X_WL[3].R.transpose());
      return kinetic_energy(model, system.simulation.state()) +
             0.5 * spring.b / b_ref * D.velocity(3, p).squaredNorm() +
             0.5 * spring.b_rotational / b_ref * D.w_WL[3].squaredNorm() +
             0.5 * spring.k * (K.position(3, spring.p_L) - p).squaredNorm() +
             0.5 * spring.k_rotational * turn.angle() * turn.angle();
    };
    double before = energy();
    const double first = before;
    double risen = 0, lost = 0;
    for (int n = 0; n < 5000; ++n) {
      const Kinematics& D = system.simulation.kinematics();
      lost += h * (spring.b * D.velocity(3, D.position(3, spring.p_L)).squaredNorm() +
                   spring.b_rotational * D.w_WL[3].squaredNorm());
      system.simulation.step(h);
      const double now = energy();
      risen = std::max(risen, now - before);
      before = now;
    }
    CHECK(risen < 1e-6 * first);
    CHECK(first - before == doctest::Approx(lost).epsilon(2e-3));  // the work of the dampers
  }
}

TEST_CASE("weld: MuJoCo's trajectories of a weld and of a pin, to 1e-9") {
  // Computed with MuJoCo 2.2.2: step 1 ms, semi-implicit Euler, solref 0.05 0.8, solimp 0.9 0.9
  // 0.001, the Newton solver to 1e-14. A mass of 0.7 kg on three slides, welded to a mocap body
  // that moves at (0.6, -0.3, 0) m/s; a hinge with an arm, pinned to a mocap body at rest.
  const SolrefParameters reference{0.05, 0.8, 0.9};
  const double g = 9.81;
  ModelBuilder slides;
  const Vector3 axes[] = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
  for (int i = 0; i < 3; ++i)
    slides.add_body(
        "b" + std::to_string(i), i, kThreeJoints[static_cast<std::size_t>(i)], JointType::prismatic,
        {}, axes[i],
        {i == 2 ? 0.7 : 0.0, Vector3::Zero(), (i == 2 ? 0.1 : 0.0) * Matrix3::Identity()});
  slides.set_gravity({0, 0, -g});
  const Model<double> mass = slides.build();
  const State<double> at_rest(mass);
  SteadyHand hand;
  hand.angle = {0.1, 0, 0.05};
  hand.rate = {0.6, -0.3, 0};
  Coupled weld_of_mass(
      mass, hand, kThreeJoints,
      weld({weld_spring("weld", mass, at_rest, 3, Vector3::Zero(), reference)}, reference),
      at_rest);
  const double expected_mass[][6] = {
      {0.10504807070068871, 1.0403547181005441, -0.011806771001558263, -0.2426383520507191,
       0.039439067986349011, 0.26882650249182299},
      {0.18228151989167027, 0.61963837915261266, -0.040497846468759986, -0.30382149469315173,
       0.049053131137202763, 0.0058094152453830898},
      {0.24189396416708067, 0.59299546609228526, -0.07077648583010665, -0.30105029287960261,
       0.048595544035045901, -0.0044096458751679644},
      {0.30159485518892409, 0.59951732435239879, -0.10080458927883727, -0.29995822728439742,
       0.048423463135220751, -0.00019330036032212493},
      {0.36159492954982747, 0.60010773796942807, -0.13080049586714357, -0.2999813785037353,
       0.048427464059817606, 7.0214859798266101e-05}};
  for (const auto& row : expected_mass) {
    for (int n = 0; n < 100; ++n) weld_of_mass.simulation.step(1e-3);
    const State<double>& x = weld_of_mass.simulation.state();
    for (std::size_t j = 0; j < 3; ++j) {
      CHECK(std::abs(x.q[j] - row[2 * j]) < 1e-9);
      CHECK(std::abs(x.qd[j] - row[2 * j + 1]) < 1e-9);
    }
  }

  ModelBuilder hinge;
  hinge.add_body("arm", 0, "joint1", JointType::revolute, {}, Vector3::UnitY(),
                 {2, {0.25, 0, 0}, Vector3(0.01, 0.02, 0.03).asDiagonal()});
  hinge.set_gravity({0, 0, -g});
  const Model<double> arm = hinge.build();
  const State<double> level(arm);
  const Spring pin = point_alone(weld_spring("pin", arm, level, 1, {0.3, 0, 0.05}, reference));
  Coupled pinned(arm, {}, {"joint1"}, weld({pin}, reference), level);
  const double expected_arm[][2] = {{0.00099700355381102329, 0.0064110345282165984},
                                    {0.0012261886700237073, 0.00021100464187072041},
                                    {0.0012218855839464993, -6.9229853949541841e-05},
                                    {0.0012190208276958432, -4.7856543517117337e-06},
                                    {0.0012189776692328794, 6.6506602366353775e-07}};
  for (const auto& row : expected_arm) {
    for (int n = 0; n < 100; ++n) pinned.simulation.step(1e-3);
    CHECK(std::abs(pinned.simulation.state().q[0] - row[0]) < 1e-9);
    CHECK(std::abs(pinned.simulation.state().qd[0] - row[1]) < 1e-9);
  }
}
