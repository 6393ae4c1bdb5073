// Scenes as the workshop of the lab hands them over.
#pragma once

#include <string>
#include <utility>

#include "app/lab/session/scene_builder_thread.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {

// The paper's robot, one joint of it drawn after a hand.
inline const std::string kSlowlyDriven = test_data("app/lab/session/slowly_driven.toml");

inline BuildResult built_from(const std::string& text) {
  const TemporaryFolder folder;
  BuildRequest order;
  order.file = folder.write("scene.toml", text);
  return build(std::move(order));
}

}  // namespace twinarm
