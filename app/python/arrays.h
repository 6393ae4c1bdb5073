// Conversion between numpy arrays and the solver's vectors; both directions copy.
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
using Array =  // contiguous and aligned
    py::array_t<double, int{py::array::c_style} | int{py::detail::npy_api::NPY_ARRAY_ALIGNED_}>;

// pybind11 asks a class for memory when an object is first used that has no value, as C.__new__(C)
// makes it. Values of this base are made by std::make_shared, which does not.
struct OnlyConstructed {
  static void* operator new(std::size_t) {
    throw py::type_error("the object was made by __new__() alone, without its constructor");
  }
};

// "(2, 6)"
std::string shape_text(const py::ssize_t* shape, py::ssize_t dimensions);
inline std::string shape_text(const py::array& array) {
  return shape_text(array.shape(), array.ndim());
}
// As an array of doubles, or TypeError; `what`: the argument in messages, "aba(): q".
Array numbers_of(const py::handle& given, const std::string& what);
// ValueError for the first number that is not finite.
void check_finite(const double* numbers, std::size_t count, const std::string& what);
// `size` finite numbers; `why`: the reason for the size in messages, "nq = 6".
std::vector<double> vector_of(const py::handle& given, std::size_t size, const std::string& what,
                              const std::string& why);

// A file name or pathlib path; assets/.. is looked up by find_input().
std::filesystem::path path_of(const py::handle& file);

Array array_of(const std::vector<double>& values);
// A read-only copy.
Array frozen(const std::vector<double>& values);
Array zeros(const std::vector<py::ssize_t>& shape);

// {name: unit}, in the order of the columns.
template <class Columns>
py::dict units_of(const Columns& columns) {
  py::dict all;
  for (const auto& column : columns) all[py::str(column.name)] = column.unit;
  return all;
}

inline void store(const Vec3<double>& v, double* to) {
  to[0] = v.x, to[1] = v.y, to[2] = v.z;
}
inline void store(const Vector3& v, double* to) {
  to[0] = v.x(), to[1] = v.y(), to[2] = v.z();
}

// Parts of the module; add_robots() first, as the others use its class.
void add_robots(pybind11::module_& m);
void add_passes(pybind11::module_& m);
void add_motion(pybind11::module_& m);
void add_workspace(pybind11::module_& m);
void add_simulation(pybind11::module_& m);
void add_scenes(pybind11::module_& m);
void add_scene_stepper(pybind11::module_& m);
void add_couplings(pybind11::module_& m);
void add_recordings(pybind11::module_& m);

}  // namespace twinarm::python
