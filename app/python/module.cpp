// The compiled part of the Python package `twinarm` (docs/use/python.md); interface:
// twinarm/__init__.pyi.
#include "app/python/arrays.h"
#include "app/support/version.h"
#include "solver/dynamics/dynamics.h"
#include "solver/support/diagnostics.h"

namespace py = pybind11;

PYBIND11_MODULE(_core, m) {
  using namespace twinarm;
  m.attr("__name__") = "twinarm";  // module of the classes
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
  python::add_robots(m);
  python::add_passes(m);
  python::add_workspace(m);
  python::add_motion(m);
  python::add_simulation(m);
  python::add_scenes(m);
  python::add_scene_stepper(m);
  python::add_couplings(m);
  python::add_recordings(m);
}
