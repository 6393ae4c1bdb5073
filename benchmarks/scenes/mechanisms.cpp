#include "benchmarks/scenes/mechanisms.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

#include "solver/dynamics/model_builder.h"

namespace twinarm::bench {
namespace {

// Uniform random numbers.
auto seeded(unsigned seed) {
  return [engine = std::mt19937(seed), unit = std::uniform_real_distribution<double>(0, 1)](
             double low = 0, double high = 1) mutable { return low + (high - low) * unit(engine); };
}

// Roll about x, pitch about y, yaw about z, fixed axes, in this order.
Eigen::Matrix3d rotation(const Vector3d& rpy) {
  const auto about = [&](const auto& axis, Eigen::Index k) {
    return Eigen::AngleAxisd(rpy[k], axis).toRotationMatrix();
  };
  return about(Vector3d::UnitZ(), 2) * about(Vector3d::UnitY(), 1) * about(Vector3d::UnitX(), 0);
}

// With these principal moments, about axes rotated by R against the body axes.
Numbers6 inertia(const Vector3d& principal, const Vector3d& rpy = Vector3d::Zero()) {
  const Eigen::Matrix3d R = rotation(rpy);
  Eigen::Matrix3d I = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) I += principal[k] * R.col(k) * R.col(k).transpose();
  return {I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)};
}

constexpr std::size_t about_x = 0, about_y = 1, about_z = 2;

Body link(int parent, std::size_t axis, const Vector3d& position, double mass, const Vector3d& com,
          const Numbers6& inertia, const Vector3d& rpy = Vector3d::Zero()) {
  Body b;
  b.parent = parent, b.joint = Joint::revolute, b.axis = axis;
  b.position = position, b.rotation = rotation(rpy);
  b.mass = mass, b.com = com, b.inertia = inertia;
  return b;
}
Scene of_links(std::vector<Body> links) {
  Scene scene;
  scene.bodies = std::move(links);
  return scene;
}

Scene scara3() {
  return of_links(
      {link(-1, about_z, {0, 0, 0.10}, 1.2, {0.05, 0.002, 0.01}, inertia({1.0e-3, 2.2e-3, 2.5e-3})),
       link(0, about_z, {0.10, 0, 0.02}, 1.0, {0.06, -0.001, 0.005},
            inertia({0.8e-3, 1.9e-3, 2.1e-3})),
       link(1, about_z, {0.12, 0, 0.01}, 0.7, {0.07, 0.001, -0.01},
            inertia({0.5e-3, 1.4e-3, 1.5e-3}))});
}

Scene puma6() {
  const Vector3d forward{std::numbers::pi / 2, 0, 0}, back{-std::numbers::pi / 2, 0, 0};
  return of_links(
      {link(-1, about_z, {0, 0, 0.67}, 10.0, {0, 0.03, -0.05}, inertia({0.25, 0.25, 0.35})),
       link(0, about_z, {0, 0.15, 0}, 17.4, {0.068, 0.006, -0.016}, inertia({0.13, 0.524, 0.539}),
            back),
       link(1, about_z, {0.4318, 0, 0.0934}, 4.8, {0, -0.070, 0.014},
            inertia({0.066, 0.0300, 0.086})),
       link(2, about_z, {-0.0203, -0.4331, 0}, 0.82, {0, 0, -0.019},
            inertia({1.8e-3, 1.8e-3, 1.3e-3}), forward),
       link(3, about_z, {0, 0, 0}, 0.34, {0, 0, 0.01}, inertia({0.3e-3, 0.3e-3, 0.4e-3}), back),
       link(4, about_z, {0, 0, 0}, 0.09, {0, 0, 0.032}, inertia({0.15e-3, 0.15e-3, 0.04e-3}),
            forward)});
}

// Random numbers of a link are drawn last property first, as in the published timings of these
// models.
Scene chain(int n) {
  Scene chain;
  auto random = seeded(7);
  for (int i = 0; i < n; ++i) {
    Body b = link(i - 1, static_cast<std::size_t>(i % 3), {0, 0, 0}, 0, {0, 0, 0}, {});
    b.com[2] = 0.01 * random();
    b.com[1] = 0.01 * random();
    b.com[0] = 0.05 + 0.01 * random();
    b.mass = 0.5 + 0.5 * random();
    if (i > 0) b.position[0] = 0.10 + 0.02 * random();
    const double yaw = random(), pitch = random(), roll = random();
    const double Izz = 1.2e-3 + 2e-4 * random();
    const double Iyy = 1.0e-3 + 2e-4 * random();
    const double Ixx = 0.8e-3 + 2e-4 * random();
    b.inertia = inertia({Ixx, Iyy, Izz}, {roll, pitch, yaw});
    chain.bodies.push_back(b);
  }
  return chain;
}

Scene humanoid30() {
  Scene body;
  auto random = seeded(11);
  // A link of about this mass, height of the com and radius of gyration.
  const auto add = [&](int parent, std::size_t axis, const Vector3d& position, double mass,
                       double height, double radius) {
    Body b = link(parent, axis, position, mass, {0, 0, height}, {});
    b.com[1] = 0.01 * random();
    b.com[0] = 0.01 * random();
    const double k = mass * radius * radius;
    const double yaw = 0.3 * random(), pitch = 0.3 * random(), roll = 0.3 * random();
    const double Izz = k * (0.9 + 0.2 * random());
    const double Iyy = k * (1 + 0.2 * random());
    const double Ixx = k * (1 + 0.2 * random());
    b.inertia = inertia({Ixx, Iyy, Izz}, {roll, pitch, yaw});
    body.bodies.push_back(b);
    return static_cast<int>(body.bodies.size()) - 1;
  };
  const int pelvis = add(-1, about_z, {0, 0, 0}, 8, 0.02, 0.12);
  body.bodies[0].joint = Joint::free;
  for (const double side : {-1.0, 1.0}) {
    int leg = add(pelvis, about_z, {0, 0.1 * side, -0.05}, 1.0, -0.02, 0.05);
    leg = add(leg, about_x, {0, 0, 0}, 1.5, -0.03, 0.05);
    leg = add(leg, about_y, {0, 0, 0}, 5, -0.18, 0.12);
    leg = add(leg, about_y, {0, 0, -0.4}, 3, -0.17, 0.1);
    leg = add(leg, about_y, {0, 0, -0.4}, 0.7, -0.01, 0.04);
    add(leg, about_x, {0, 0, 0}, 1.0, -0.03, 0.05);
  }
  int torso = add(pelvis, about_z, {0, 0, 0.12}, 1.5, 0.03, 0.06);
  torso = add(torso, about_y, {0, 0, 0.05}, 12, 0.18, 0.15);
  for (const double side : {-1.0, 1.0}) {
    int arm = add(torso, about_y, {0, 0.2 * side, 0.3}, 0.8, 0, 0.04);
    arm = add(arm, about_x, {0, 0.03 * side, 0}, 0.8, -0.02, 0.04);
    arm = add(arm, about_z, {0, 0, -0.05}, 1.4, -0.12, 0.07);
    arm = add(arm, about_y, {0, 0, -0.25}, 0.9, -0.03, 0.05);
    arm = add(arm, about_z, {0, 0, -0.05}, 0.7, -0.1, 0.06);
    arm = add(arm, about_y, {0, 0, -0.2}, 0.3, -0.01, 0.03);
    add(arm, about_x, {0, 0, 0}, 0.4, -0.05, 0.04);
  }
  const int neck = add(torso, about_z, {0, 0, 0.4}, 0.5, 0.02, 0.03);
  add(neck, about_y, {0, 0, 0.04}, 3, 0.08, 0.08);
  return body;
}

// Cubes of 1 kg.
constexpr double box_edge = 0.1, contact_friction = 0.6;

// From there on the name is a number from 1 to 9999.
bool has_count(const std::string& name, std::size_t first) {
  return name.size() > first && name.size() < first + 5 && name[first] != '0' &&
         name.find_first_not_of("0123456789", first) == std::string::npos;
}

Scene pushing_scara() {
  Scene scene = scara3();
  Body& last = scene.bodies.back();
  last.form = Form::sphere, last.half = {0.02, 0.02, 0.02}, last.form_at = {0.14, 0, 0};
  scene.fixed_boxes = {{{0.2206, 0.3053, 0.13}, Vector3d::Constant(box_edge / 2)}};
  scene.control = Control{{0.6, 0.3, 0.2}, 20, 0.5};
  scene.q.assign(3, 0), scene.v.assign(3, 0);
  return scene;
}

}  // namespace

Body solid_ball(double mass, double radius) {
  Body b;
  b.mass = mass, b.form = Form::sphere, b.half = {radius, radius, radius};
  const double I = 0.4 * mass * radius * radius;
  b.inertia = {I, I, I, 0, 0, 0};
  return b;
}
Body solid_cube(double mass, double edge) {
  Body b;
  b.mass = mass, b.form = Form::box, b.half = {edge / 2, edge / 2, edge / 2};
  const double I = mass * edge * edge / 6;
  b.inertia = {I, I, I, 0, 0, 0};
  return b;
}
void add_free_body(Scene& scene, const Body& body, const Vector3d& p, const Vector3d& v) {
  scene.bodies.push_back(body);
  scene.q.insert(scene.q.end(), {p[0], p[1], p[2], 1, 0, 0, 0});
  scene.v.insert(scene.v.end(), {0, 0, 0, v[0], v[1], v[2]});
}

int heap_size(const std::string& name) {
  for (const std::string form : {"spheres", "boxes"})
    if (name.starts_with(form) && has_count(name, form.size()))
      return std::stoi(name.substr(form.size()));
  return 0;
}

TimedScene timed_scene(const std::string& name) {
  TimedScene timed{{}, 2e-3, 2000};
  if (const int count = heap_size(name); count > 0)
    return {heap(name.starts_with("boxes") ? Form::box : Form::sphere, count), 2e-3, 750};
  Scene& scene = timed.scene;
  const auto add_box = [&](int row, double x) {
    add_free_body(scene, solid_cube(1, box_edge), {x, 0, 0.055 + 0.101 * row});
  };
  if (name == "scara") {
    timed = {pushing_scara(), 1e-3, 5000};
  } else if (name == "wall100") {
    for (int column = 0; column < 10; ++column)
      for (int row = 0; row < 10; ++row) add_box(row, 0.15 * (column - 4.5));
  } else if (name == "pyr55") {
    for (int row = 0; row < 10; ++row)
      for (int i = 0; i < 10 - row; ++i) add_box(row, 0.11 * (i - (9 - row) / 2.0));
  } else {
    throw std::invalid_argument("no scene " + name +
                                ": there are wall100, pyr55, scara, spheresN, boxesN");
  }
  scene.floor = scene.fixed_boxes.empty();
  scene.floor_friction = scene.friction = contact_friction;
  return timed;
}

Scene mechanism(const std::string& name) {
  if (name == "scara3") return scara3();
  if (name == "puma6") return puma6();
  if (name == "humanoid30") return humanoid30();
  if (name.starts_with("chain") && has_count(name, 5)) return chain(std::stoi(name.substr(5)));
  throw std::invalid_argument("no model " + name +
                              ": there are scara3, puma6, humanoid30 and chainN, N from 1 to 9999");
}

std::vector<Situation> situations(const Scene& mechanism, std::size_t count) {
  auto random = seeded(42);
  const bool floats = mechanism.floats();
  const std::size_t joints = mechanism.bodies.size() - (floats ? 1 : 0);
  // Base: linear before angular; then in the order of Joint.
  const auto swap_base = [floats](std::vector<double>& v) {
    if (floats) std::rotate(v.begin(), v.begin() + 3, v.begin() + 6);
  };
  std::vector<Situation> all(count);
  for (Situation& s : all) {
    if (floats) {
      for (int k = 0; k < 3; ++k) s.q.push_back(random(-0.5, 0.5));
      double norm = 0;
      for (int k = 0; k < 4; ++k) s.q.push_back(random(-1, 1)), norm += s.q.back() * s.q.back();
      for (std::size_t k = 3; k < 7; ++k) s.q[k] /= std::sqrt(norm);
      for (int k = 0; k < 6; ++k) s.v.push_back(random(-1, 1)), s.tau.push_back(random(-10, 10));
    }
    for (std::size_t j = 0; j < joints; ++j) {
      s.q.push_back(random(-2, 2));
      s.v.push_back(random(-1, 1));
      s.tau.push_back(random(-1, 1));
    }
    for (std::size_t j = 0; j < s.v.size(); ++j) s.qdd.push_back(random(-1, 1));
    swap_base(s.v), swap_base(s.tau), swap_base(s.qdd);
  }
  return all;
}

Model<double> model_of(const Scene& scene) {
  ModelBuilder builder;
  builder.set_gravity(scene.gravity);
  int number = 0;
  for (const Body& b : scene.bodies) {
    const JointType type = b.joint == Joint::revolute    ? JointType::revolute
                           : b.joint == Joint::spherical ? JointType::spherical
                                                         : JointType::free;
    const std::string name = std::to_string(++number);
    builder.add_body(name, b.parent + 1, "joint " + name, type, {b.rotation, b.position},
                     axis_of(b), {b.mass, b.com, inertia3(b.inertia)});
  }
  return builder.build();
}

}  // namespace twinarm::bench
