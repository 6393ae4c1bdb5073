// The scenes of the soak run, a little different in each episode.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "app/scene/read/scene_description.h"

namespace twinarm::soak {

// The same numbers everywhere, which the distributions of the standard library are not.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(uniform(0, double(n))); }
  Vector3 direction() {
    Vector3 d;
    do d = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    while (d.norm() > 1 || d.norm() < 0.1);
    return d.normalized();
  }

 private:
  std::mt19937_64 engine_;
};

struct SoakScene {
  SceneDescription description;
  // Origins of free bodies stay within, [m].
  Vector3 low{-100, -100, 0}, high{100, 100, 100};
  double push = 1;  // strength of the shoves: at most so many m/s for most of them
};

const std::vector<std::string>& scene_names();  // stack, pyramid, arm, mixed
SoakScene make_scene(const std::string& name, Chance& chance);

}  // namespace twinarm::soak
