#include "benchmarks/drivers/contact_measure.h"

#include <algorithm>
#include <cmath>

#include "benchmarks/scenes/eigen.h"
#include "collision/detection/collision_world.h"

namespace twinarm::bench {
namespace {

// Where bodies are, on revolutes and free.
std::vector<Pose> poses_of(const Scene& scene, const std::vector<double>& q) {
  std::vector<Pose> poses;
  const double* at = q.data();
  for (const Body& b : scene.bodies) {
    Pose X{matrix3(b.rotation), vector3(b.position)};
    if (b.joint == Joint::free)
      X = {quaternion(at + 3).normalized().toRotationMatrix(), Vector3(at)};
    else
      X.R = X.R * Eigen::AngleAxisd(at[0], axis_of(b)).toRotationMatrix();
    if (b.parent >= 0) {
      const Pose& parent = poses[index(b.parent)];
      X = {parent.R * X.R, parent.p + parent.R * X.p};
    }
    poses.push_back(X);
    at += coordinates_of(b.joint);
  }
  return poses;
}

}  // namespace

struct ContactMeasure::Detection {
  CollisionWorld world;
  std::vector<Pose> X_WG;  // what is fixed comes first
  std::vector<Contact> contacts;

  double deepest() {
    world.detect(X_WG, 0.0, contacts);
    double depth = 0;
    for (const Contact& contact : contacts) depth = std::max(depth, contact.depth);
    return depth;
  }
};

ContactMeasure::ContactMeasure(const TimedScene& timed)
    : timed_(timed), detection_(std::make_unique<Detection>()) {
  Detection& d = *detection_;
  const Scene& scene = timed_.scene;
  if (scene.obstacle) {
    d.world.add({"obstacle", Box{2 * vector3(scene.obstacle->half)}, 0, true});
    d.X_WG.push_back({Matrix3::Identity(), vector3(scene.obstacle->centre)});
  } else {
    d.world.add({"floor", HalfSpace{}, 0, true});
    d.X_WG.emplace_back();
  }
  for (const Body& b : scene.bodies) {
    if (b.form == Form::sphere) d.world.add({"ball", Sphere{b.half[0]}});
    if (b.form == Form::box) d.world.add({"box", Box{2 * vector3(b.half)}});
  }
  d.X_WG.resize(static_cast<std::size_t>(d.world.size()));
}

ContactMeasure::~ContactMeasure() = default;

void ContactMeasure::take(int step, const std::vector<double>& q) {
  const Scene& scene = timed_.scene;
  const std::vector<Pose> X_WB = poses_of(scene, q);
  std::size_t shape = 1;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.bodies[i].form != Form::none)
      detection_->X_WG[shape++] = {X_WB[i].R,
                                   X_WB[i].p + X_WB[i].R * vector3(scene.bodies[i].form_at)};
  penetration_ = detection_->deepest();
  largest_ = std::max(largest_, penetration_);
  drift_ = 0;
  if (!scene.obstacle) {
    for (std::size_t i = 0; i < q.size(); i += 7)
      drift_ = std::max(drift_, std::hypot(q[i] - scene.q[i], q[i + 1] - scene.q[i + 1]));
    return;
  }
  const Vector3& tip = detection_->X_WG.back().p;
  if (step < timed_.steps - timed_.steps / 5)
    Vector3::Map(reference_.data()) = tip;
  else
    drift_ = (tip - Vector3(reference_.data())).norm();
}

}  // namespace twinarm::bench
