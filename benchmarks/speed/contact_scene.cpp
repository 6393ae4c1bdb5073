#include "benchmarks/speed/contact_scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "benchmarks/speed/eigen.h"
#include "collision/detection/collision_world.h"

namespace twinarm::speed {

ContactScene contact_scene(const std::string& name) {
  if (name == "scara") return {name, 1e-3, 5000, {}};
  ContactScene scene{name, 2e-3, 2000, {}};
  const auto height = [](int row) { return 0.055 + 0.101 * row; };
  if (name == "wall100") {
    for (int column = 0; column < 10; ++column)
      for (int row = 0; row < 10; ++row)
        scene.boxes.push_back({0.15 * (column - 4.5), 0, height(row)});
  } else if (name == "pyr55") {
    for (int row = 0; row < 10; ++row)
      for (int i = 0; i < 10 - row; ++i)
        scene.boxes.push_back({0.11 * (i - (9 - row) / 2.0), 0, height(row)});
  } else {
    throw std::invalid_argument("no scene " + name + ": there are wall100, pyr55, scara");
  }
  return scene;
}

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

ContactMeasure::ContactMeasure(const ContactScene& scene)
    : scene_(scene), detection_(std::make_unique<Detection>()) {
  const Box box{{box_edge, box_edge, box_edge}};
  Detection& d = *detection_;
  if (scene.has_arm()) {
    d.world.add({"obstacle", box, 0, true});
    d.X_WG.push_back({Matrix3::Identity(), vector3(Push{}.obstacle)});
    d.world.add({"tip", Sphere{Push{}.radius}});
  } else {
    d.world.add({"floor", HalfSpace{}, 0, true});
    d.X_WG.emplace_back();
    for (std::size_t i = 0; i < scene.boxes.size(); ++i)
      d.world.add({"box" + std::to_string(i), box});
  }
  d.X_WG.resize(static_cast<std::size_t>(d.world.size()));
}

ContactMeasure::~ContactMeasure() = default;

void ContactMeasure::take(int step, const std::vector<Placed>& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const auto& [w, x, y, z] = bodies[i].orientation;
    detection_->X_WG[i + 1] = {Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix(),
                               vector3(bodies[i].position)};
  }
  penetration_ = detection_->deepest();
  largest_ = std::max(largest_, penetration_);
  drift_ = 0;
  if (!scene_.has_arm()) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
      drift_ = std::max(drift_, std::hypot(bodies[i].position[0] - scene_.boxes[i][0],
                                           bodies[i].position[1] - scene_.boxes[i][1]));
  } else if (step < scene_.steps - scene_.steps / 5) {
    reference_ = bodies[0];
  } else {
    drift_ = (vector3(bodies[0].position) - vector3(reference_.position)).norm();
  }
}

}  // namespace twinarm::speed
