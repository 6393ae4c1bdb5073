// The Python module `twinarm`: docs/use/python.md. What it takes and gives is said in twinarm.pyi.
#include "app/python/arrays.h"
#include "app/support/version.h"
#include "solver/dynamics/dynamics.h"
#include "solver/support/diagnostics.h"

namespace py = pybind11;

PYBIND11_MODULE(twinarm, m) {
  using namespace twinarm;
  m.doc() =
      "twinarm: a glass-box multibody laboratory.\n\n"
      "SI units and radians; axes right-handed, z up. Arrays are numpy's, float64. Spatial "
      "vectors\n"
      "of six have the turning part first: (w; v), (n; f). Numbers of bodies count the base as 0.\n"
      "RBDA is R. Featherstone, Rigid Body Dynamics Algorithms, Springer 2008.\n\n"
      "Example:\n"
      "    import numpy as np, twinarm\n"
      "    puma = twinarm.load('assets/robots/puma560/puma560.urdf')\n"
      "    twinarm.aba(puma, np.zeros(6), np.zeros(6), np.zeros(6))";
  m.attr("__version__") = kProgramVersion;
  m.attr("instruction_set") = name_of(best_isa());
  py::register_exception<InputError>(m, "InputError", PyExc_ValueError).doc() =
      "A file or an option is wrong. The text tells all faults, one per line: where, which rule,\n"
      "which remedy.";
  python::add_robots(m);
  python::add_passes(m);
  python::add_workspace(m);
  python::add_motion(m);
  python::add_simulation(m);
  python::add_scenes(m);
  python::add_couplings(m);
  python::add_recordings(m);
}
