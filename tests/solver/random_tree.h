// Random mechanisms and states: seeded, so that a failure can be run again.
#pragma once

#include <Eigen/Geometry>
#include <random>

#include "solver/model.h"

namespace twinarm::testing {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  Vector3 vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Matrix3 rotation() {
    return Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))
        .normalized()
        .toRotationMatrix();
  }
  // Of a cloud of points, so it is one that a body can have.
  BodyInertia inertia() {
    BodyInertia body;
    body.mass = uniform(0.2, 3);
    body.com = vector(0.2);
    for (int k = 0; k < 5; ++k) {
      const Vector3 r = vector(0.3);
      body.inertia += body.mass / 5 * (r.squaredNorm() * Matrix3::Identity() - r * r.transpose());
    }
    return body;
  }

 private:
  std::mt19937 engine_;
};

// A tree of n bodies; joint types drawn from the given list.
inline Model<double> random_tree(Random& random, int n, const std::vector<JointType>& types) {
  ModelBuilder builder;
  for (int i = 1; i <= n; ++i) {
    const JointType type =
        types[static_cast<std::size_t>(random.integer(0, static_cast<int>(types.size()) - 1))];
    builder.add_body("body" + std::to_string(i), random.integer(std::max(0, i - 3), i - 1),
                     "joint" + std::to_string(i), type, {random.rotation(), random.vector(0.5)},
                     random.vector(1), random.inertia());
  }
  return builder.build();
}

inline State<double> random_state(Random& random, const Model<double>& model) {
  State<double> x(model);
  for (double& q : x.q) q = random.uniform(-3, 3);
  for (double& qd : x.qd) qd = random.uniform(-2, 2);
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    if (model.joint[i] == JointType::free) {
      Eigen::Map<Eigen::Vector4d> quaternion(&x.q[model.iq[i] + 3]);
      quaternion.normalize();
    }
  return x;
}

}  // namespace twinarm::testing
