// Between numpy's arrays and the solver's vectors: what comes in is checked and copied, what goes
// out is a copy.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <filesystem>
#include <string>
#include <vector>

#include "solver/dynamics/kinematics.h"
#include "solver/spatial/spatial.h"

namespace twinarm::python {

namespace py = pybind11;
using Array = py::array_t<double, py::array::c_style>;

// "(2, 6)"
std::string shape_text(const py::array& array);
// As an array of doubles, or TypeError; `what` as messages name it: "aba(): q".
Array numbers_of(const py::handle& given, const std::string& what);
// ValueError for the first number that is not finite.
void check_finite(const double* numbers, std::size_t count, const std::string& what);
// `size` finite numbers in one row; `why` says where the size comes from: "nq = 6".
std::vector<double> vector_of(const py::handle& given, std::size_t size, const std::string& what,
                              const std::string& why);

// A file by its name, or as a path of pathlib; what begins with assets/ as the program finds it.
std::filesystem::path path_of(const py::handle& file);

Array array_of(const std::vector<double>& values);
// A copy that refuses to be written to: a change of it would change nothing.
Array frozen(const std::vector<double>& values);
Array zeros(const std::vector<py::ssize_t>& shape);

inline void store(const Vec3<double>& v, double* to) {
  to[0] = v.x, to[1] = v.y, to[2] = v.z;
}
inline void store(const Vector3& v, double* to) {
  to[0] = v.x(), to[1] = v.y(), to[2] = v.z();
}

// The parts of the module. Each adds its functions and classes; add_robots comes first, whose class
// the others name.
void add_robots(pybind11::module_& m);
void add_passes(pybind11::module_& m);
void add_motion(pybind11::module_& m);
void add_workspace(pybind11::module_& m);
void add_simulation(pybind11::module_& m);
void add_scenes(pybind11::module_& m);
void add_couplings(pybind11::module_& m);
void add_recordings(pybind11::module_& m);

}  // namespace twinarm::python
