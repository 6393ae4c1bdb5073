// The mechanisms and scenes that are timed.
//
//   scara3, puma6 (of the size of a PUMA 560), chainN (n links with full inertia tensors, axes
//   x, y, z in turn), humanoid30 (30 revolutes on a free base)
//
//   wall100  ten columns of ten boxes; the gaps of 1 mm close by falling, then all is at rest
//   pyr55    a pyramid of 55 boxes, dropped likewise: every box lies on two others
//   scara    the arm scara3; PD control pushes a ball at its tip into a fixed box
#pragma once

#include "benchmarks/scenes/scene.h"
#include "solver/model/model.h"

namespace twinarm::bench {

// By name: "scara3", "puma6", "humanoid30", "chainN". Throws std::invalid_argument.
Scene mechanism(const std::string& name);

// Seeded: every run and every engine gets the same ones. Of a mechanism of revolutes, whose first
// body may be free.
std::vector<Situation> situations(const Scene& mechanism, std::size_t count);

// A scene with contacts that is run by steps of h [s].
struct TimedScene {
  Scene scene;
  double h;
  int steps;
};
inline constexpr std::array<const char*, 3> timed_scene_names = {"wall100", "pyr55", "scara"};
TimedScene timed_scene(const std::string& name);  // throws std::invalid_argument

// A scene's mechanism as a model of ours: its coordinates and velocities are those of the scene.
Model<double> model_of(const Scene& scene);

}  // namespace twinarm::bench
