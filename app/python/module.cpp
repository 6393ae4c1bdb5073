// The compiled part of the Python package `twinarm` (docs/use/python.md); interface:
// twinarm/__init__.pyi.
#include <exception>

#include "app/python/arrays.h"
#include "app/support/version.h"
#include "solver/dynamics/dynamics.h"
#include "solver/support/diagnostics.h"

namespace py = pybind11;

namespace {

PyTypeObject* base_of_all_classes() {
  return reinterpret_cast<PyTypeObject*>(py::detail::get_internals().instance_base);
}
// pybind11's base class has no value: making one, as protocols 0 and 1 of pickle do, would end the
// interpreter.
PyObject* new_of_class(PyTypeObject* type, PyObject*, PyObject*) {
  if (type != base_of_all_classes()) return py::detail::make_new_instance(type);
  PyErr_SetString(PyExc_TypeError, "objects of twinarm cannot be pickled");
  return nullptr;
}

// Texts with the bytes of an argument or a file need not be UTF-8.
void raise(PyObject* kind, const char* what) {
  const py::handle text =
      PyUnicode_DecodeUTF8(what, static_cast<Py_ssize_t>(std::strlen(what)), "backslashreplace");
  PyErr_SetObject(kind, text.ptr());
  text.dec_ref();
}
void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const twinarm::InputError& error) {
    raise(py::module_::import("twinarm").attr("InputError").ptr(), error.what());
  } catch (const py::builtin_exception& error) {
    error.set_error();
    const py::object kind = py::reinterpret_borrow<py::object>(PyErr_Occurred());
    PyErr_Clear();
    raise(kind.ptr(), error.what());
  }
}

// pybind11 2.10 ends the interpreter when its message about wrong arguments names a keyword that is
// not UTF-8: here it is a UnicodeEncodeError.
struct CheckedFunction : py::cpp_function {
  static PyObject* call(PyObject* self, PyObject* arguments, PyObject* keywords) {
    Py_ssize_t at = 0;
    PyObject* name = nullptr;
    while (keywords != nullptr && PyDict_Next(keywords, &at, &name, nullptr))
      if (PyUnicode_AsUTF8(name) == nullptr) return nullptr;
    return dispatcher(self, arguments, keywords);
  }
  // Of a module and its classes.
  static void replace_all_of(const py::handle& owner) {
    for (auto [unused, member] : py::dict(owner.attr("__dict__"))) {
      py::object function = py::getattr(member, "__func__", member);
      if (PyInstanceMethod_Check(function.ptr()))
        function = py::reinterpret_borrow<py::object>(PyInstanceMethod_GET_FUNCTION(member.ptr()));
      if (PyType_Check(function.ptr())) replace_all_of(function);
      if (!PyCFunction_Check(function.ptr())) continue;
      PyCFunction& code = reinterpret_cast<PyCFunctionObject*>(function.ptr())->m_ml->ml_meth;
      const auto function_of = [](auto* with_keywords) {
        return reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(with_keywords));
      };
      if (code == function_of(dispatcher)) code = function_of(call);
    }
  }
};

}  // namespace

PYBIND11_MODULE(_core, m) {
  using namespace twinarm;
  base_of_all_classes()->tp_new = new_of_class;  // inherited by the classes below
  m.attr("__name__") = "twinarm";                // module of the classes
  m.doc() =
      "twinarm: rigid-body dynamics solver with inspectable algorithms.\n\n"
      "SI units and radians; axes right-handed, z up. Arrays are numpy's, float64. Spatial "
      "vectors\n"
      "have the angular part first: (w; v), (n; f). The base is body 0.\n"
      "RBDA is R. Featherstone, Rigid Body Dynamics Algorithms, Springer 2008.\n\n"
      "Example:\n"
      "    import numpy as np, twinarm\n"
      "    puma = twinarm.load('assets/robots/puma560/puma560.urdf')\n"
      "    twinarm.aba(puma, np.zeros(6), np.zeros(6), np.zeros(6))";
  m.attr("__version__") = kProgramVersion;
  m.attr("instruction_set") = name_of(best_isa());
  py::register_exception<InputError>(m, "InputError", PyExc_ValueError).doc() =
      "Invalid file or option. The text has one error per line: where, problem, fix.";
  py::register_exception_translator(translate);
  python::add_robots(m);
  python::add_passes(m);
  python::add_workspace(m);
  python::add_motion(m);
  python::add_simulation(m);
  python::add_scenes(m);
  python::add_scene_stepper(m);
  python::add_couplings(m);
  python::add_recordings(m);
  CheckedFunction::replace_all_of(m);
}
