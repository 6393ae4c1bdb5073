// Random mechanisms and states, seeded.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "solver/dynamics/model_builder.h"
#include "solver/model/configuration.h"

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
  // Inertia of a cloud of points: physically consistent.
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

// Builder input of one body; its index is its position in the list, from 1.
struct TreeBody {
  int parent = 0;
  JointType type = JointType::fixed;
  Pose X_PJ;
  Vector3 axis = Vector3::UnitZ();
  BodyInertia inertia;
  JointProperties properties;
};

inline Model<double> build(const std::vector<TreeBody>& bodies,
                           const Vector3& gravity = {0, 0, -9.81}) {
  ModelBuilder builder;
  builder.set_gravity(gravity);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const TreeBody& b = bodies[i];
    const std::string number = std::to_string(i + 1);
    builder.add_body("body" + number, b.parent, "joint" + number, b.type, b.X_PJ, b.axis, b.inertia,
                     b.properties);
  }
  return builder.build();
}

// A tree of n bodies; joint types drawn from the given list.
inline std::vector<TreeBody> random_bodies(Random& random, int n,
                                           const std::vector<JointType>& types) {
  std::vector<TreeBody> bodies;
  for (int i = 1; i <= n; ++i) {
    TreeBody b;
    b.type = types[static_cast<std::size_t>(random.integer(0, static_cast<int>(types.size()) - 1))];
    b.inertia = random.inertia();
    b.axis = random.vector(1);
    b.X_PJ.R = random.rotation();
    b.X_PJ.p = random.vector(0.5);
    b.parent = random.integer(std::max(0, i - 3), i - 1);
    if (b.type == JointType::screw) b.properties.pitch = random.uniform(-0.3, 0.3);
    bodies.push_back(b);
  }
  return bodies;
}
inline Model<double> random_tree(Random& random, int n, const std::vector<JointType>& types) {
  return build(random_bodies(random, n, types));
}

// The same, ill-conditioned: masses up to 1e4 apart, rotors on every third joint.
inline std::vector<TreeBody> uneven_bodies(Random& random, int n,
                                           const std::vector<JointType>& types) {
  std::vector<TreeBody> bodies = random_bodies(random, n, types);
  for (TreeBody& b : bodies) {
    const double scale = std::pow(10, random.uniform(-2, 2)) / b.inertia.mass;
    b.inertia.mass *= scale;
    b.inertia.inertia *= scale;
    if (random.integer(0, 2) == 0) b.properties.armature = random.uniform(0, 1);
  }
  return bodies;
}

inline State<double> random_state(Random& random, const Model<double>& model) {
  State<double> x(model);
  std::vector<double> all = q_with_prescribed(model, x);
  for (double& q : all) q = random.uniform(-3, 3);
  set_q_with_prescribed(model, all, x);
  for (double& qd : x.qd) qd = random.uniform(-2, 2);
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const int at = facts_of(model.joint[i]).quaternion;
    if (at >= 0)
      Eigen::Map<Eigen::Vector4d>(&x.q[model.iq[i] + static_cast<std::size_t>(at)]).normalize();
  }
  return x;
}

inline const std::vector<JointType> kAllJoints{all_joint_types.begin(), all_joint_types.end()};

// Lists of joint types: each type alone, and all mixed.
inline std::vector<std::vector<JointType>> lists_of_types() {
  std::vector<std::vector<JointType>> lists;
  for (const JointType type : all_joint_types) lists.push_back({type});
  lists.push_back(kAllJoints);
  return lists;
}

}  // namespace twinarm::testing
