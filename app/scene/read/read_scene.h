// Reads a scene file (docs/scenes.md).
#pragma once

#include <filesystem>

#include "app/data/value.h"
#include "app/scene/read/scene_description.h"
#include "collision/import/robot/file_search.h"

namespace twinarm {

// Throws InputError with ALL faults of the scene and of its robots' files, each with its line.
SceneDescription read_scene(const std::filesystem::path& file);
// The same of a tree that was read, and perhaps changed; `file` as faults name it, and to find the
// files that it names, which must lie in `roots`.
SceneDescription read_scene(const Value& root, const std::filesystem::path& file,
                            const FileRoots& roots = {});

}  // namespace twinarm
