// Contact quality of a run: twinarm's collision detection at the poses of an engine.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "benchmarks/scenes/mechanisms.h"
#include "collision/detection/collision_world.h"
#include "solver/dynamics/kinematics.h"

namespace twinarm::bench {

class ContactMeasure {
 public:
  explicit ContactMeasure(const TimedScene& timed) : timed_(timed), model_(model_of(timed.scene)) {
    const Scene& scene = timed_.scene;
    if (scene.floor) world_.add({"floor", HalfSpace{}, 0, true});
    for (const Scene::FixedBox& box : scene.fixed_boxes) {
      world_.add({"fixed", Box{2 * box.half}, 0, true});
      container_.extend(box.centre - box.half).extend(box.centre + box.half);
    }
    first_ = static_cast<std::size_t>(world_.size());
    for (const Body& b : scene.bodies) {
      if (b.form == Form::sphere) world_.add({"ball", Sphere{b.half[0]}});
      if (b.form == Form::box) world_.add({"box", Box{2 * b.half}});
    }
    X_WG_.resize(static_cast<std::size_t>(world_.size()));
    for (std::size_t i = 0; i < scene.fixed_boxes.size(); ++i)
      X_WG_[first_ - scene.fixed_boxes.size() + i].p = scene.fixed_boxes[i].centre;
  }

  // After a step; q as in Scene.
  void measure(int step, const std::vector<double>& q) {
    const Scene& scene = timed_.scene;
    State<double> x(model_);
    x.q = q;
    if (scene.floats())  // free bodies; some engines return quaternions in single precision
      for (std::size_t i = 3; i < q.size(); i += 7) Eigen::Vector4d::Map(&x.q[i]).normalize();
    const Kinematics k = kinematics_at(model_, x);
    std::size_t shape = first_;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      if (scene.bodies[i].form != Form::none)
        X_WG_[shape++] = {k.X_WL[i + 1].R, k.X_WL[i + 1] * scene.bodies[i].form_at};
    std::vector<Contact> contacts;
    world_.detect(X_WG_, 0.0, contacts);
    penetration = drift = 0;
    for (const Contact& contact : contacts) penetration = std::max(penetration, contact.depth);
    max_penetration = std::max(max_penetration, penetration);
    if (scene.floats())
      for (std::size_t i = 0; i < q.size(); i += 7)
        drift = std::max(drift, std::hypot(q[i] - scene.q[i], q[i + 1] - scene.q[i + 1]));
    else if (step < timed_.steps - timed_.steps / 5)
      reference_ = X_WG_.back().p;
    else
      drift = (X_WG_.back().p - reference_).norm();
  }
  // Bodies whose centre is outside the bounding box of the fixed boxes.
  std::ptrdiff_t escaped() const {
    return std::count_if(X_WG_.begin() + static_cast<std::ptrdiff_t>(first_), X_WG_.end(),
                         [&](const Pose& X) { return !container_.contains(Vector3d(X.p)); });
  }

  double penetration = 0, max_penetration = 0;  // deepest point of the last step, of all [m]
  // [m] Boxes: largest horizontal distance from the start. Ball: creep in the last fifth of a run.
  double drift = 0;

 private:
  TimedScene timed_;
  Model<double> model_;
  CollisionWorld world_;
  std::vector<Pose> X_WG_;  // fixed shapes first
  std::size_t first_ = 0;   // of the bodies
  Eigen::AlignedBox3d container_;
  Vector3 reference_ = Vector3::Zero();
};

}  // namespace twinarm::bench
