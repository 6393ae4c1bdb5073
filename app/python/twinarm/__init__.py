"""twinarm: rigid-body dynamics solver with inspectable algorithms.

SI units and radians; axes right-handed, z up. Arrays are numpy's, float64. Spatial vectors have the
angular part first: (w; v), (n; f). The base is body 0. RBDA is R. Featherstone, Rigid Body Dynamics
Algorithms, Springer 2008.

Example:
    import numpy as np, twinarm
    puma = twinarm.load('assets/robots/puma560/puma560.urdf')
    twinarm.aba(puma, np.zeros(6), np.zeros(6), np.zeros(6))
"""
from twinarm._core import *  # noqa: F401, F403: Model, aba, rnea, crba, ...
from twinarm._core import __version__  # noqa: F401
from twinarm._inspection import Inspection  # noqa: F401
from twinarm._recording import Recording, open_recording  # noqa: F401
from twinarm._run import Run, simulate  # noqa: F401
from twinarm._samples import Samples  # noqa: F401
from twinarm._scene_simulation import SceneSimulation  # noqa: F401
from twinarm._viewer import view  # noqa: F401
