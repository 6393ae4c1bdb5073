// Scenes with faults, each with what is to be said of it: scene_errors/NAME.toml ends with a line
// for each fault, # fault LINE CODE VALUE. Those named good_* have none: they stand on the near
// side of a rule.
#include "app/scene/forces/scene_couplings.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {
namespace {

TEST_CASE(
    "scene: each faulty file gives all its faults, with line, code and value, and no others") {
  int files = 0;
  for (const auto& entry :
       fs::directory_iterator(TWINARM_SOURCE_DIR "/tests/app/scene/forces/scene_errors")) {
    const fs::path file = entry.path();
    INFO(file.filename().string());
    const auto faults = faults_of([&] {
      const SceneModel scene = build_scene(read_scene(file));
      SceneCouplings(scene, scene.description.step);
    });
    check_faults(faults, expected_in(text_of(file), "# fault ", ""), file);
    ++files;
  }
  CHECK(files == 133);
}

}  // namespace
}  // namespace twinarm
