"""What the tests of `twinarm map` share: a scene of one hinge, and running the command."""
import math

from golden_hashes import GENERIC
from program import ProgramTest, data, line_of

INERTIA = 0.5  # of hinge.urdf
MEASURES = ("stable", "max_error", "mean_error", "energy", "passivity")
ARM = "assets/scenes/tracking_map.toml"


def is_stable_of_order(order):
    """Of explicit Runge-Kutta schemes: by their polynomial, for alpha = k h^2 / I and beta = b h / I."""
    def is_stable(alpha, beta):
        root = complex(beta * beta / 4 - alpha) ** 0.5
        return all(abs(sum(z ** i / math.factorial(i) for i in range(order + 1))) < 1
                   for z in (-beta / 2 + root, -beta / 2 - root))
    return is_stable


class MapCommand(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("hinge.urdf", data("hinge.urdf"))

    def scene(self, discretization="explicit", damping=1.0, duration=20.0, name="scene.toml"):
        return self.write(name, data("map_hinge.toml", duration=duration, damping=damping,
                                     discretization=discretization))

    def map(self, scene, *options, name="work.twinmap", **more):
        return self.json_of("map", scene, *options, "--checkpoint", self.folder / name, **more)

    def faults(self, *arguments):
        return super().faults("map", *arguments)

    def refused(self, code, value, *arguments):
        """There is a fault of that code, which tells the value or the name."""
        self.tells(self.faults(*arguments), code, value)

    def tells(self, faults, code, value):
        self.assertTrue(any(f["code"] == code and value in line_of(f) for f in faults), (code, value, faults))

    def check_both_ways(self, scene, *options):
        """Cells side by side are those that run one by one; by measure, the plane. At the level of the instruction
        set where lanes round as numbers do: unstable runs grow what fused multiply-adds round otherwise."""
        planes, number = {}, len(list(self.folder.iterdir()))  # a work file of each way holds all measures
        for measure in MEASURES:
            planes[measure], alone = (self.map(scene, *options, "--measure", measure, *way,
                                               name=f"{number}{way}", env=GENERIC)["values"]
                                      for way in ([], ["--no-simd"]))
            for row, other in zip(planes[measure], alone):
                for value, wanted in zip(row, other):
                    self.assertEqual(value is None, wanted is None, measure)
                    if wanted is not None:
                        self.assertAlmostEqual(value, wanted, delta=1e-9 * max(1, abs(wanted)), msg=measure)
        return planes
