// Scenes built as by the scene builder thread.
#pragma once

#include <string>
#include <utility>

#include "app/lab/session/scene_builder_thread.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {

// The paper's robot, one joint coupled to a target.
inline const std::string kSlowlyDriven = test_data("app/lab/session/slowly_driven.toml");

inline BuildResult built_from(const std::string& text) {
  const TemporaryFolder folder;
  BuildRequest request;
  request.file = folder.write("scene.toml", text);
  return build(std::move(request));
}

}  // namespace twinarm
