#include "benchmarks/speed/models.h"

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace twinarm::speed {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low = 0, double high = 1) { return low + (high - low) * unit_(engine_); }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<double> unit_{0, 1};
};

Numbers9 product(const Numbers9& A, const Numbers9& B) {
  Numbers9 C{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) C[3 * i + j] += A[3 * i + k] * B[3 * k + j];
  return C;
}

Numbers9 transpose(const Numbers9& A) {
  return {A[0], A[3], A[6], A[1], A[4], A[7], A[2], A[5], A[8]};
}

// Turns by roll about x, then pitch about y, then yaw about z, all fixed axes.
Numbers9 turn(const Numbers3& rpy) {
  using std::cos, std::sin;
  const auto [roll, pitch, yaw] = rpy;
  const Numbers9 X = {1, 0, 0, 0, cos(roll), -sin(roll), 0, sin(roll), cos(roll)};
  const Numbers9 Y = {cos(pitch), 0, sin(pitch), 0, 1, 0, -sin(pitch), 0, cos(pitch)};
  const Numbers9 Z = {cos(yaw), -sin(yaw), 0, sin(yaw), cos(yaw), 0, 0, 0, 1};
  return product(product(Z, Y), X);
}

// With these principal moments about axes that are turned so against the link's.
Numbers9 inertia(const Numbers3& principal, const Numbers3& rpy = {0, 0, 0}) {
  const Numbers9 R = turn(rpy);
  const Numbers9 D = {principal[0], 0, 0, 0, principal[1], 0, 0, 0, principal[2]};
  return product(product(R, D), transpose(R));
}

constexpr std::size_t x = 0, y = 1, z = 2;
constexpr Numbers3 straight = {0, 0, 0};

}  // namespace

Mechanism scara3() {
  const Numbers9 R = turn(straight);
  return {
      "scara3",
      {{-1, z, {0, 0, 0.10}, R, 1.2, {0.05, 0.002, 0.01}, inertia({1.0e-3, 2.2e-3, 2.5e-3})},
       {0, z, {0.10, 0, 0.02}, R, 1.0, {0.06, -0.001, 0.005}, inertia({0.8e-3, 1.9e-3, 2.1e-3})},
       {1, z, {0.12, 0, 0.01}, R, 0.7, {0.07, 0.001, -0.01}, inertia({0.5e-3, 1.4e-3, 1.5e-3})}}};
}

Mechanism puma6() {
  const double right = std::numbers::pi / 2;
  const Numbers9 R = turn(straight), forward = turn({right, 0, 0}), back = turn({-right, 0, 0});
  return {"puma6",
          {{-1, z, {0, 0, 0.67}, R, 10.0, {0, 0.03, -0.05}, inertia({0.25, 0.25, 0.35})},
           {0, z, {0, 0.15, 0}, back, 17.4, {0.068, 0.006, -0.016}, inertia({0.13, 0.524, 0.539})},
           {1, z, {0.4318, 0, 0.0934}, R, 4.8, {0, -0.070, 0.014}, inertia({0.066, 0.0300, 0.086})},
           {2,
            z,
            {-0.0203, -0.4331, 0},
            forward,
            0.82,
            {0, 0, -0.019},
            inertia({1.8e-3, 1.8e-3, 1.3e-3})},
           {3, z, {0, 0, 0}, back, 0.34, {0, 0, 0.01}, inertia({0.3e-3, 0.3e-3, 0.4e-3})},
           {4, z, {0, 0, 0}, forward, 0.09, {0, 0, 0.032}, inertia({0.15e-3, 0.15e-3, 0.04e-3})}}};
}

// The random numbers of a link are drawn last property first: the order that published timings of
// these models were made with.
Mechanism chain(int n) {
  Mechanism chain{"chain" + std::to_string(n), {}};
  Random random(7);
  for (int i = 0; i < n; ++i) {
    Link link{i - 1, static_cast<std::size_t>(i % 3), {0, 0, 0}, turn(straight), 0, {}, {}};
    link.com[2] = 0.01 * random();
    link.com[1] = 0.01 * random();
    link.com[0] = 0.05 + 0.01 * random();
    link.mass = 0.5 + 0.5 * random();
    if (i > 0) link.position[0] = 0.10 + 0.02 * random();
    const double yaw = random(), pitch = random(), roll = random();
    const double Izz = 1.2e-3 + 2e-4 * random();
    const double Iyy = 1.0e-3 + 2e-4 * random();
    const double Ixx = 0.8e-3 + 2e-4 * random();
    link.inertia = inertia({Ixx, Iyy, Izz}, {roll, pitch, yaw});
    chain.links.push_back(link);
  }
  return chain;
}

Mechanism humanoid30() {
  Mechanism body{"humanoid30", {}, true};
  Random random(11);
  // A link of this mass, its com at this height, and this radius of gyration; all of it roughly.
  const auto add = [&](int parent, std::size_t axis, const Numbers3& position, double mass,
                       double height, double radius) {
    Link link{parent, axis, position, turn(straight), mass, {0, 0, height}, {}};
    link.com[1] = 0.01 * random();
    link.com[0] = 0.01 * random();
    const double k = mass * radius * radius;
    const double yaw = 0.3 * random(), pitch = 0.3 * random(), roll = 0.3 * random();
    const double Izz = k * (0.9 + 0.2 * random());
    const double Iyy = k * (1 + 0.2 * random());
    const double Ixx = k * (1 + 0.2 * random());
    link.inertia = inertia({Ixx, Iyy, Izz}, {roll, pitch, yaw});
    body.links.push_back(link);
    return static_cast<int>(body.links.size()) - 1;
  };
  const int pelvis = add(-1, z, {0, 0, 1}, 8, 0.02, 0.12);
  for (const double side : {-1.0, 1.0}) {
    int leg = add(pelvis, z, {0, 0.1 * side, -0.05}, 1.0, -0.02, 0.05);
    leg = add(leg, x, {0, 0, 0}, 1.5, -0.03, 0.05);
    leg = add(leg, y, {0, 0, 0}, 5, -0.18, 0.12);
    leg = add(leg, y, {0, 0, -0.4}, 3, -0.17, 0.1);
    leg = add(leg, y, {0, 0, -0.4}, 0.7, -0.01, 0.04);
    add(leg, x, {0, 0, 0}, 1.0, -0.03, 0.05);
  }
  int torso = add(pelvis, z, {0, 0, 0.12}, 1.5, 0.03, 0.06);
  torso = add(torso, y, {0, 0, 0.05}, 12, 0.18, 0.15);
  for (const double side : {-1.0, 1.0}) {
    int arm = add(torso, y, {0, 0.2 * side, 0.3}, 0.8, 0, 0.04);
    arm = add(arm, x, {0, 0.03 * side, 0}, 0.8, -0.02, 0.04);
    arm = add(arm, z, {0, 0, -0.05}, 1.4, -0.12, 0.07);
    arm = add(arm, y, {0, 0, -0.25}, 0.9, -0.03, 0.05);
    arm = add(arm, z, {0, 0, -0.05}, 0.7, -0.1, 0.06);
    arm = add(arm, y, {0, 0, -0.2}, 0.3, -0.01, 0.03);
    add(arm, x, {0, 0, 0}, 0.4, -0.05, 0.04);
  }
  const int neck = add(torso, z, {0, 0, 0.4}, 0.5, 0.02, 0.03);
  add(neck, y, {0, 0, 0.04}, 3, 0.08, 0.08);
  return body;
}

Mechanism mechanism(const std::string& name) {
  if (name == "scara3") return scara3();
  if (name == "puma6") return puma6();
  if (name == "humanoid30") return humanoid30();
  if (name.starts_with("chain") && name.size() > 5 && name.size() < 10 &&
      name.find_first_not_of("0123456789", 5) == std::string::npos && name[5] != '0')
    return chain(std::stoi(name.substr(5)));
  throw std::invalid_argument("no model " + name +
                              ": there are scara3, puma6, humanoid30 and chainN, N from 1 to 9999");
}

std::vector<Situation> situations(const Mechanism& mechanism, std::size_t count) {
  Random random(42);
  std::vector<Situation> all(count);
  for (Situation& s : all) {
    if (mechanism.floating) {
      for (int k = 0; k < 3; ++k) s.q.push_back(random(-0.5, 0.5));
      double norm = 0;
      for (int k = 0; k < 4; ++k) s.q.push_back(random(-1, 1)), norm += s.q.back() * s.q.back();
      for (std::size_t k = 3; k < 7; ++k) s.q[k] /= std::sqrt(norm);
      for (int k = 0; k < 6; ++k) s.v.push_back(random(-1, 1)), s.tau.push_back(random(-10, 10));
    }
    for (std::size_t j = 0; j < mechanism.joints(); ++j) {
      s.q.push_back(random(-2, 2));
      s.v.push_back(random(-1, 1));
      s.tau.push_back(random(-1, 1));
    }
    for (std::size_t j = 0; j < mechanism.nv(); ++j) s.qdd.push_back(random(-1, 1));
  }
  return all;
}

}  // namespace twinarm::speed
