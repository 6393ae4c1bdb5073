// Mechanisms and scenes for timing.
//
//   scara3, puma6 (of the size of a PUMA 560), chainN (n links with full inertia tensors, axes
//   x, y, z in turn), humanoid30 (30 revolutes on a free base)
//
//   wall100  ten columns of ten boxes; gaps of 1 mm close by falling, then at rest
//   pyr55    a pyramid of 55 boxes, dropped likewise; each box rests on two others
//   scara    the arm scara3; PD control pushes a ball at its tip into a fixed box
//   spheresN, boxesN  a heap: N bodies of 0.1 m and 1 kg fall into a container, friction 0.5; the
//            floor area is proportional to N
#pragma once

#include "benchmarks/scenes/scene.h"
#include "solver/model/model.h"

namespace twinarm::bench {

// By name: "scara3", "puma6", "humanoid30", "chainN". Throws std::invalid_argument.
Scene mechanism(const std::string& name);

// Seeded: identical for every run and engine. For revolute trees, optionally with a free base.
std::vector<Situation> situations(const Scene& mechanism, std::size_t count);

// A scene with contacts and its step h [s].
struct TimedScene {
  Scene scene;
  double h;
  int steps;
};
inline constexpr std::array<const char*, 13> timed_scene_names = {
    "wall100",     "pyr55",   "scara",    "spheres30", "spheres100", "spheres300", "spheres1000",
    "spheres3000", "boxes30", "boxes100", "boxes300",  "boxes1000",  "boxes3000"};
Scene heap(Form form, int count);  // of spheres or boxes
// The number of bodies of a heap of that name; 0: not a heap.
int heap_size(const std::string& name);
TimedScene timed_scene(const std::string& name);  // throws std::invalid_argument

// The mechanism of a scene as a Model with the same coordinates and velocities.
Model<double> model_of(const Scene& scene);

}  // namespace twinarm::bench
