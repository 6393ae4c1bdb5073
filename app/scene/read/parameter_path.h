// A number of a scene file, named by the way to it from the top:
//
//   step                       of the scene itself
//   gravity[2]                 in a list of numbers, from 0
//   coupling[0].stiffness      of one of several [[coupling]]
//   coupling.stiffness         of all of them
//   coupling.pull.stiffness    of the one with name = "pull"
//   robot.q.joint1, body.shape.sphere.radius, coupling.target.q.joint1
#pragma once

#include <string>

#include "app/data/toml_tree.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// Puts the number there. The last key of the path may be one that the table leaves out: whether
// there is such a key, the reader of the scene knows. Where the path leads nowhere, adds a fault at
// `where`, with the nearest names. What it writes stands in `line`, by which later faults are
// known.
void set_number(TomlValue& scene, const std::string& path, double value, int line,
                const std::string& where, FaultList& faults);

// What is measured in which unit, by the path's last key; empty where that is not known. Of a
// stiffness it depends on the couplings that are meant.
std::string unit_of_number(const TomlValue& scene, const std::string& path);

}  // namespace twinarm
