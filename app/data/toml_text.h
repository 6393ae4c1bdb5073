// A tree of TOML as text again (app/data/toml_tree.h).
#pragma once

#include <filesystem>
#include <string>

#include "app/data/toml_tree.h"

namespace twinarm {

// Comments are gone; numbers are written in the fewest digits that read back as they were. Tables
// of lists stand under [[key]], all other tables in one line.
std::string to_toml(const TomlValue& root);

// Files of a scene in `folder`, by names relative to it, are named from the root: a copy of the
// scene may lie elsewhere.
void name_files_from_root(const std::filesystem::path& folder, TomlValue& scene);

}  // namespace twinarm
