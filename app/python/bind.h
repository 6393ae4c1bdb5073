// The parts of the module. Each adds its functions and classes; add_robots comes first, whose class
// the others name.
#pragma once

#include <pybind11/pybind11.h>

namespace twinarm::python {

void add_robots(pybind11::module_& m);
void add_passes(pybind11::module_& m);
void add_motion(pybind11::module_& m);
void add_workspace(pybind11::module_& m);
void add_simulation(pybind11::module_& m);
void add_scenes(pybind11::module_& m);
void add_couplings(pybind11::module_& m);
void add_recordings(pybind11::module_& m);

}  // namespace twinarm::python
