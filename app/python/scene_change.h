// set={"coupling.pull.stiffness": 800}: changes of a scene before it is read.
#pragma once

#include <pybind11/pybind11.h>

#include "app/run/simulate_input.h"

namespace twinarm::python {

// Adds the changes to options with a model. `set`: None, or a dict by path of numbers, texts,
// booleans or lists of numbers. TypeError for other values, ValueError if the model is not a scene.
void change_scene(const pybind11::object& set, SimulateOptions& options);

}  // namespace twinarm::python
