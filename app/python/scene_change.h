// set={"coupling.pull.stiffness": 800}: what a call changes in a scene before it is read.
#pragma once

#include <pybind11/pybind11.h>

#include "app/run/simulate_input.h"

namespace twinarm::python {

// Puts it into the options, whose model is named already. `set`: None, or a dict by path; values
// are numbers, texts, flags, or lists of numbers. TypeError for others, ValueError for a robot
// that is no scene.
void change_scene(const pybind11::object& set, SimulateOptions& options);

}  // namespace twinarm::python
