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

inline std::vector<Fault> scene_faults(const std::string& text) {
  return faults_of([&] { scene_of(text); });
}

// The one fault: its line, its code, and a value, key or name that it tells.
inline void check_fault(const std::string& text, int line, const std::string& code,
                        const std::string& value = "") {
  INFO(text);
  const std::vector<Fault> faults = scene_faults(text);
  std::string all;
  for (const Fault& fault : faults) all += to_string(fault) + "\n";
  INFO(all);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].line == line);
  CHECK(faults[0].file.find("test.toml") != std::string::npos);
  CHECK(faults[0].code == code);
  CHECK(to_string(faults[0]).find(value) != std::string::npos);
}

inline bool close(const Matrix3& a, const Matrix3& b, double tolerance = 1e-14) {
  return (a - b).cwiseAbs().maxCoeff() <= tolerance * std::max(1.0, b.cwiseAbs().maxCoeff());
}
inline bool close(const Vector3& a, const Vector3& b, double tolerance = 1e-14) {
  return (a - b).cwiseAbs().maxCoeff() <= tolerance * std::max(1.0, b.cwiseAbs().maxCoeff());
}

}  // namespace twinarm
