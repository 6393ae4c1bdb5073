// Device mappings: kinematics against forward kinematics, forces against virtual work by
// differences.
#include <doctest/doctest.h>

#include <cmath>

#include "coupling/device/inverse_kinematics.h"
#include "solver/support/diagnostics.h"
#include "tests/coupling/analysis/two_link.h"
#include "tests/coupling/device/mapped_robots.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

const OmniParameters kOmni;
constexpr double kLong = 1e3;  // [s] between calls: no speed limit

MappingSpec spec_of_kind(MappingKind which) {
  MappingSpec spec;
  spec.kind = which;
  return spec;
}
double max_change(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t j = 0; j < a.size(); ++j) most = std::max(most, std::abs(a[j] - b[j]));
  return most;
}
// Two links in the plane, with closed-form nearest points.
struct PlaneArm {
  TwoLink arm;
  Model<double> model = arm.model();
  MappedRobot robot;
  PlaneArm() {
    robot.model = &model;
    robot.turned = {1, 2};
    robot.body = 2;
    robot.p_L = {arm.l2, 0, 0};
  }
  double reach() const { return arm.l1 + arm.l2; }
};

}  // namespace

TEST_CASE("joint mappings: q = offset + gain theta, of theta1, 4, 6 or of theta1, 2, 3") {
  const MappedModel s103("s103", "s103/s103.urdf", {"joint1", "joint2", "joint3"}, "quill",
                         Vector3(0, 0, 0));
  Random random(1);
  for (const MappingKind which : {MappingKind::paper, MappingKind::arm}) {
    MappingSpec spec = spec_of_kind(which);
    spec.offset = {0.1, -0.2, 0.3};
    const auto mapping = make_mapping(spec, kOmni, s103.robot);
    const std::array<std::size_t, 3> joint = which == MappingKind::paper
                                                 ? std::array<std::size_t, 3>{0, 3, 5}
                                                 : std::array<std::size_t, 3>{0, 1, 2};
    std::vector<double> before;
    for (int n = 0; n < 50; ++n) {
      DeviceState device = device_at(kOmni, random_angles(kOmni, random));
      device.buttons[0] = n % 3 == 0;
      const MappedTarget& target = mapping->map(device, 0.01);
      CHECK(target.gripper_closed == (n % 3 == 0));
      for (std::size_t j = 0; j < 3; ++j) {
        CHECK(
            target.q[j] ==
            doctest::Approx(spec.offset[j] + spec.gain[j] * device.theta[joint[j]]).epsilon(1e-14));
        if (n > 0)
          CHECK(target.qd[j] == doctest::Approx((target.q[j] - before[j]) / 0.01).epsilon(1e-12));
      }
      before = target.q;
    }
  }
}

TEST_CASE("the paper's mapping gives no torque on theta2 and theta3") {
  const auto robots = mapped_robots();
  const auto mapping = make_mapping(spec_of_kind(MappingKind::paper), kOmni, robots[0]->robot);
  Random random(2);
  for (int n = 0; n < 50; ++n) {
    const DeviceState device = device_at(kOmni, random_angles(kOmni, random));
    mapping->map(device, 0.001);
    const double tau = random.uniform(-9, 9);
    const DeviceForce motors = mapping->motor_torques(device, {tau, random.uniform(-9, 9), 5});
    CHECK(motors.torque[0] == doctest::Approx(2 * tau));
    CHECK(motors.torque[1] == 0);
    CHECK(motors.torque[2] == 0);
  }
}

// Virtual work by central differences of map(). With the paper's mapping only theta1, which has a
// motor, is moved.
TEST_CASE("the motors' power equals that of the robot's joints: all mappings, all robots") {
  Random random(3);
  for (const auto& m : mapped_robots())
    for (const MappingKind which : {MappingKind::paper, MappingKind::arm, MappingKind::cartesian}) {
      if (which != MappingKind::cartesian && m->robot.turned.size() > 3) continue;
      CAPTURE(m->name);
      int counted = 0;
      for (int n = 0; n < 200; ++n) {
        const auto mapping = make_mapping(spec_of_kind(which), kOmni, m->robot);
        const OmniAngles theta = random_angles(kOmni, random);
        const std::vector<double> q = m->random_q(random);
        std::vector<double> tau;
        for (std::size_t j = 0; j < q.size(); ++j) tau.push_back(random.uniform(-3, 3));
        std::array<double, 3> d{};
        for (std::size_t j = 0; j < (which == MappingKind::paper ? 1 : 3); ++j)
          d[j] = random.uniform(-1e-5, 1e-5);
        const auto moved = [&](double part) {
          OmniAngles at = theta;
          for (std::size_t j = 0; j < 3; ++j) at[j] += part * d[j];
          mapping->begin(device_at(kOmni, theta), q);
          return mapping->map(device_at(kOmni, at), kLong).q;
        };
        const std::vector<double> plus = moved(1), minus = moved(-1), here = moved(0);
        if (max_change(plus, minus) > 1e-3) continue;  // near a singularity
        const DeviceForce motors = mapping->motor_torques(device_at(kOmni, theta), tau);
        double of_robot = 0, of_hand = 0, size = 0;
        for (std::size_t j = 0; j < q.size(); ++j) {
          of_robot += tau[j] * (plus[j] - minus[j]);
          size += std::abs(tau[j] * (plus[j] - minus[j]));
        }
        for (std::size_t j = 0; j < 3; ++j) of_hand += motors.torque[j] * 2 * d[j];
        CHECK(std::abs(of_robot - of_hand) < 2e-4 * size + 1e-14);
        ++counted;
      }
      CHECK(counted > 150);
    }
}

TEST_CASE("cartesian: the robot's point is p_start + scale (stylus - start) within reach") {
  Random random(4);
  for (const auto& m : mapped_robots()) {
    CAPTURE(m->name);
    const bool plane = m->name.starts_with("S-103");
    MappingSpec spec = spec_of_kind(MappingKind::cartesian);
    spec.scale = 1.5;
    int reached = 0;
    for (int n = 0; n < 60; ++n) {
      const auto mapping = make_mapping(spec, kOmni, m->robot);
      const OmniAngles theta = random_angles(kOmni, random), to = random_angles(kOmni, random);
      const std::vector<double> q = m->random_q(random);
      const DeviceState start = device_at(kOmni, theta);
      mapping->begin(start, q);
      CHECK(max_change(mapping->map(start, 0.001).q, q) < 1e-10);
      OmniAngles at = theta;
      for (int s = 1; s <= 40; ++s) {
        for (std::size_t j = 0; j < 6; ++j) at[j] = theta[j] + s / 40.0 * (to[j] - theta[j]);
        mapping->map(device_at(kOmni, at), kLong);
      }
      const DeviceState end = device_at(kOmni, at);
      const std::vector<double> found = mapping->map(end, kLong).q;
      for (std::size_t j = 0; j < q.size(); ++j) {
        CHECK(found[j] >= m->robot.lower[j]);
        CHECK(found[j] <= m->robot.upper[j]);
      }
      Vector3 goal = m->point(q) + 1.5 * world_from_device(end.stylus.p - start.stylus.p);
      if (plane) goal.z() = m->point(q).z();  // planar motion only
      if ((m->point(found) - goal).norm() < 1e-9) ++reached;
    }
    CHECK(reached > 20);
  }
}

TEST_CASE("a goal out of reach: the arm points to it, at the nearest point, and comes back") {
  const PlaneArm plane;
  PointInverseKinematics inverse(plane.robot);
  inverse.set_pose({0.2, 0.9});
  const double reach = plane.reach();
  inverse.move_towards(Vector3(0.4 * std::cos(0.6), 0.4 * std::sin(0.6), 0), 10);
  std::vector<double> before = inverse.q();
  double jump = 0;
  for (int n = 0; n <= 4000; ++n) {  // out to three times the reach, around, and in again
    const double s = n / 4000.0, r = 0.4 + (3 * reach - 0.4) * std::sin(M_PI * s);
    const double turn = 0.6 + 1.2 * s;
    const Vector3 goal(r * std::cos(turn), r * std::sin(turn), 0);
    inverse.move_towards(goal, 1);
    jump = std::max(jump, max_change(inverse.q(), before));
    before = inverse.q();
    const double nearest = std::max(0.0, r - reach);
    CHECK(std::abs((goal - inverse.position()).norm() - nearest) < 1e-9);
  }
  // Bending from the stretched pose is a square root of the distance: 1.5 mm a tick here.
  CHECK(jump < 0.2);
}

TEST_CASE("a stretched arm bends if the goal moves straight in") {
  const PlaneArm plane;
  PointInverseKinematics inverse(plane.robot);
  inverse.set_pose({0.0, 0.0});
  for (const double in : {0.001, 0.01, 0.1, 0.2}) {
    const Vector3 goal(plane.reach() - in, 0, 0);
    for (int n = 0; n < 3; ++n) inverse.move_towards(goal, 10);
    CHECK((inverse.position() - goal).norm() < 1e-9);
  }
}

TEST_CASE("no joint exceeds the maximum speed, and the robot catches up") {
  const auto robots = mapped_robots();
  MappingSpec spec = spec_of_kind(MappingKind::cartesian);
  spec.fastest = 2;
  spec.scale = 2;
  const auto mapping = make_mapping(spec, kOmni, robots[2]->robot);
  OmniAngles theta{0, 0.5, 0.2, 0, 0, 0};
  const std::vector<double> q{0.3, 0.9, -0.6};
  const DeviceState start = device_at(kOmni, theta);
  mapping->begin(start, q);
  mapping->map(start, 0.001);
  theta[0] = 0.4;
  const DeviceState end = device_at(kOmni, theta);
  std::vector<double> before = q;
  for (int n = 0; n < 600; ++n) {
    const MappedTarget& target = mapping->map(end, 0.001);
    CHECK(max_change(target.q, before) < 0.002 * (1 + 1e-9));
    for (const double rate : target.qd) CHECK(std::abs(rate) < 2 * (1 + 1e-9));
    before = target.q;
  }
  const Vector3 goal =
      robots[2]->point(q) + spec.scale * world_from_device(end.stylus.p - start.stylus.p);
  PointInverseKinematics at_once(robots[2]->robot);
  at_once.set_pose(q);
  for (int n = 0; n < 5; ++n) at_once.move_towards(goal, 10);
  CHECK((robots[2]->point(before) - at_once.position()).norm() < 1e-7);
}

TEST_CASE("no jump by the clutch, by a lost device, or by invalid values") {
  Random random(5);
  const auto robots = mapped_robots();
  for (const MappingKind which : {MappingKind::paper, MappingKind::arm, MappingKind::cartesian}) {
    MappingSpec spec = spec_of_kind(which);
    spec.scale = 0.5;
    const auto mapping = make_mapping(spec, kOmni, robots[2]->robot);
    OmniAngles theta{0, 0.6, 0.1, 0, 0, 0};
    mapping->begin(device_at(kOmni, theta), {0.3, 0.9, -0.6});
    std::vector<double> before{0.3, 0.9, -0.6};
    int away = 0, moved = 0;
    for (int n = 0; n < 5000; ++n) {
      if (random.integer(0, 40) == 0) away = random.integer(0, 3);
      for (std::size_t j = 0; j < 6; ++j)
        theta[j] = std::clamp(theta[j] + random.uniform(-0.002, 0.002) * (away ? 20 : 1),
                              kOmni.lower[j], kOmni.upper[j]);
      DeviceState device = device_at(kOmni, theta);
      device.buttons[1] = away == 1;
      device.alive = away != 2;
      if (away == 3) device.theta[0] = std::nan("");
      const MappedTarget& target = mapping->map(device, 0.001);
      const double way = max_change(target.q, before);
      if (away) {
        CHECK(way == 0);
        for (const double rate : target.qd) CHECK(rate == 0);
        for (const double torque : mapping->motor_torques(device, {1, 2, 3}).torque)
          CHECK(torque == 0);
      } else {
        CHECK(way < 0.021);  // `fastest` of cartesian, a gain of 2 of the others
        moved += way > 0;
      }
      before = target.q;
    }
    CHECK(moved > 500);
  }
}

TEST_CASE("map() and motor_torques() do not allocate") {
  Random random(6);
  for (const auto& m : mapped_robots())
    for (const MappingKind which : {MappingKind::paper, MappingKind::cartesian}) {
      if (which == MappingKind::paper && m->robot.turned.size() > 3) continue;
      const auto mapping = make_mapping(spec_of_kind(which), kOmni, m->robot);
      const std::vector<double> tau(m->robot.turned.size(), 1.0);
      CHECK(allocations_in([&] {
              for (int n = 0; n < 100; ++n) {
                const DeviceState device = device_at(kOmni, random_angles(kOmni, random));
                mapping->map(device, 0.001);
                mapping->motor_torques(device, tau);
              }
            }) == 0);
    }
}

TEST_CASE("an invalid mapping is rejected with all its errors") {
  const auto robots = mapped_robots();
  MappingSpec spec = spec_of_kind(MappingKind::paper);
  spec.gain[1] = std::nan("");
  spec.scale = 0;
  MappedRobot robot = robots[3]->robot;  // six joints
  robot.lower.pop_back();
  try {
    make_mapping(spec, kOmni, robot);
    FAIL("not refused");
  } catch (const InputError& error) {
    CHECK(error.faults().size() == 4);
  }
  robot = robots[2]->robot;
  robot.body = 0;
  CHECK_THROWS_AS(make_mapping(spec_of_kind(MappingKind::cartesian), kOmni, robot), InputError);
}
