// Fast parsing of arguments: an empty pybind11 function with a model and three arrays takes as long
// as aba() of six joints.
#pragma once

#include "app/python/arrays.h"
#include "app/python/robots.h"

namespace twinarm::python {

// Positional and keyword arguments by index; null if not given.
template <std::size_t n>
struct Arguments {
  std::array<PyObject*, n> at{};

  // `names` as in the stub; the first `required` are mandatory.
  Arguments(const char* function, const std::array<const char*, n>& names, std::size_t required,
            PyObject* const* given, Py_ssize_t positional, PyObject* keywords) {
    if (static_cast<std::size_t>(positional) > n)
      throw py::type_error(std::string(function) + "() takes at most " + std::to_string(n) +
                           " arguments, " + std::to_string(positional) + " were given");
    for (std::size_t i = 0; i < static_cast<std::size_t>(positional); ++i) at[i] = given[i];
    const Py_ssize_t named = keywords ? PyTuple_GET_SIZE(keywords) : 0;
    for (Py_ssize_t k = 0; k < named; ++k) {
      PyObject* name = PyTuple_GET_ITEM(keywords, k);
      std::size_t i = 0;
      while (i < n && PyUnicode_CompareWithASCIIString(name, names[i]) != 0) ++i;
      if (i == n || at[i])
        throw py::type_error(std::string(function) + "(): '" + std::string(py::str(name)) +
                             (i == n ? "' is not an argument" : "' is given twice"));
      at[i] = given[positional + k];
    }
    for (PyObject*& argument : at)
      if (argument == Py_None) argument = nullptr;
    for (std::size_t i = 0; i < required; ++i)
      if (!at[i]) throw py::type_error(std::string(function) + "(): '" + names[i] + "' is missing");
  }
};

// The robot in the first argument.
Robot& robot_of(const char* function, PyObject* given);

// A vector of `size` numbers, or one row per call.
class Rows {
 public:
  Rows(const char* function, const char* name, PyObject* given, std::size_t size,
       const Robot& robot);
  // Finite, or ValueError.
  void copy(std::size_t row, std::vector<double>& to) const;
  bool is_one() const { return is_one_; }
  std::size_t count() const { return count_; }

 private:
  void check_shape(int dimensions, const py::ssize_t* shape, const Robot& robot);

  const char *function_, *name_;
  py::object kept_;
  const double* data_ = nullptr;
  std::size_t size_, count_ = 1;
  bool is_one_ = true;
};

// Number of calls; ValueError if rows do not agree. A single vector applies to all rows.
struct Calls {
  std::size_t count = 1;
  bool is_one = true;
  Calls(const char* function, std::initializer_list<const Rows*> all);
};

// A new array, or `given` if it has this shape: (rows, shape), or `shape` for a single call.
class Output {
 public:
  Output(const char* function, PyObject* given, const Calls& calls,
         std::initializer_list<std::size_t> shape);
  double* row(std::size_t r) { return data_ + r * size_; }
  PyObject* get() const { return kept_.ptr(); }
  PyObject* release() { return kept_.release().ptr(); }

 private:
  py::object kept_;
  double* data_ = nullptr;
  std::size_t size_ = 1;
};

// Runs f; C++ exceptions become Python exceptions, with result null.
template <class F>
PyObject* guarded(F&& f) {
  try {
    return f();
  } catch (py::error_already_set& error) {
    error.restore();
  } catch (const py::builtin_exception& error) {
    error.set_error();
  } catch (const std::exception& error) {
    PyErr_SetString(PyExc_RuntimeError, error.what());
  }
  return nullptr;
}

}  // namespace twinarm::python
