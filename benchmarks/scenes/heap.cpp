// A heap: bodies on a grid with random offsets and orientations fall into a container.
#include <cmath>
#include <random>

#include "benchmarks/scenes/mechanisms.h"

namespace twinarm::bench {
namespace {

constexpr double size_of_body = 0.1, wall = 0.1;  // diameter, edge; thickness [m]

void add_container(Scene& scene, double width, double height) {
  const double t = wall / 2, a = width / 2;
  scene.fixed_boxes.push_back({{0, 0, -t}, {a + wall, a + wall, t}});
  for (const double side : {-1.0, 1.0}) {
    scene.fixed_boxes.push_back({{side * (a + t), 0, height / 2}, {t, a + wall, height / 2}});
    scene.fixed_boxes.push_back({{0, side * (a + t), height / 2}, {a, t, height / 2}});
  }
}

}  // namespace

// Cells of the grid contain a body in all orientations. At rest the bodies fill a height of about
// 0.45 m, four to six layers. Random numbers are raw, as distributions differ between libraries.
Scene heap(Form form, int count) {
  const bool boxes = form == Form::box;
  const double cell = boxes ? 0.18 : 0.12, offset = boxes ? 0.003 : 0.005;  // horizontal, largest
  const double layers = boxes ? 10 : 7.3;
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(count / layers))));
  std::mt19937 generator(5);
  const auto random = [&generator] {  // in [-1, 1]
    return 2 * static_cast<double>(generator()) / std::mt19937::max() - 1;
  };
  Scene scene;
  scene.floor_friction = scene.friction = 0.5;
  const Body body = boxes ? solid_cube(1, size_of_body) : solid_ball(1, size_of_body / 2);
  for (int i = 0; i < count; ++i) {
    Vector3d p(i % side - (side - 1) / 2.0, i / side % side - (side - 1) / 2.0,
               i / (side * side) + 0.5);
    p *= cell;
    for (int k = 0; k < 2; ++k) p[k] += offset * random();
    add_free_body(scene, body, p);
    Eigen::Vector4d turn;
    do
      for (double& x : turn) x = random();
    while (turn.squaredNorm() > 1 || turn.squaredNorm() < 0.01);
    Eigen::Vector4d::Map(&scene.q[scene.q.size() - 4]) = turn.normalized();
  }
  add_container(scene, side * cell, scene.q[scene.q.size() - 5] + 0.5);
  return scene;
}

}  // namespace twinarm::bench
