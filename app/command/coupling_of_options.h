// A scene of one robot and one coupling, made from the options of `twinarm coupling predict`.
#pragma once

#include "app/command/commands.h"
#include "app/data/toml_tree.h"

namespace twinarm {

// The tree that such a scene file would have; its values are checked where scenes are read.
TomlValue scene_of_options(const CouplingPredictOptions& options, FaultList& faults);

}  // namespace twinarm
