// Invalid scenes with their errors: scene_errors/NAME.toml ends with a line
// for each error, # fault LINE CODE VALUE. Those named good_* have none: they are just
// inside a range.
#include "app/scene/forces/scene_couplings.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {
namespace {

TEST_CASE("scene: each invalid file gives exactly its errors, with line, code and value") {
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
  CHECK(files == 134);
}

}  // namespace
}  // namespace twinarm
