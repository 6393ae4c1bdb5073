// What the tests of app/scene share: scenes written as text.
#pragma once

#include <doctest/doctest.h>

#include "app/scene/model/scene_model.h"
#include "app/scene/read/read_scene.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {

inline SceneDescription scene_of(const std::string& text) {
  const TemporaryFolder folder;
  return read_scene(folder.write("test.toml", text));
}

inline SceneModel built(const std::string& text) {
  return build_scene(scene_of(text));
}

inline bool close(const Matrix3& a, const Matrix3& b, double tolerance = 1e-14) {
  return (a - b).cwiseAbs().maxCoeff() <= tolerance * std::max(1.0, b.cwiseAbs().maxCoeff());
}
inline bool close(const Vector3& a, const Vector3& b, double tolerance = 1e-14) {
  return (a - b).cwiseAbs().maxCoeff() <= tolerance * std::max(1.0, b.cwiseAbs().maxCoeff());
}

}  // namespace twinarm
