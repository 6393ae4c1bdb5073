"""`simulate --forces`: accelerations, joint reactions and named forces as time series, against closed forms."""
import csv
import io
import math

from program import ProgramTest, main
from robot_command import PENDULUM

G = 9.81
SLIDER_CRANK = "assets/scenes/slider_crank.toml"

SWING = """step = 0.0005
integrator = "rk4"
[[body]]
name = "sled"
shape = { box = { size = [0.2, 0.2, 0.2] } }
mass = 3
position = [1, 0, 0]
[[constraint]]
name = "cable"
type = "distance"
a = "sled"
b = "world"
point = [1, 0, 0]
point_b = [0, 0, 0]
[[spring]]
name = "coil"
a = "sled"
b = "world"
point = [1, 0, 0]
point_b = [1, 0, -2]
stiffness = 10
rest_length = 1
"""

STACK = """step = 0.001
[[body]]
name = "floor"
fixed = true
shape = { halfspace = { normal = [0, 0, 1], offset = 0 } }
[[body]]
name = "low"
shape = { box = { size = [0.2, 0.2, 0.2] } }
mass = 2
position = [0, 0, 0.1]
[[body]]
name = "high"
shape = { box = { size = [0.1, 0.1, 0.1] } }
mass = 1
position = [0, 0, 0.25]
"""


class ForcesOverTime(ProgramTest):
    def rows(self, *args):
        text = self.twinarm("simulate", *args, "--csv", "--forces").stdout
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(io.StringIO(text))]

    def test_the_pivot_of_a_pendulum_carries_weight_and_centripetal_force(self):
        robot, state = self.write("pendulum.urdf", PENDULUM), self.write("state.json", '{"q": {"hinge": 1}}')
        # 0.0137 lies between two steps.
        run = self.json_of("simulate", robot, "--state", state, "--integrator", "rk4", "--step", 0.001,
                           "--duration", 1, "--at", "0,0.0137,0.5,1", "--forces")
        for sample in run["samples"]:
            angle, rate = sample["q"]["hinge"], sample["qd"]["hinge"]
            tension = G * math.cos(angle) + rate**2
            with self.subTest(t=sample["t"]):
                self.assertAlmostEqual(sample["qdd"]["hinge"], -G * math.sin(angle), delta=1e-9)
                force = sample["joint_forces"]["hinge"]["force"]
                along = [-math.sin(angle), 0, math.cos(angle)]
                for component, direction in zip(force, along):
                    self.assertAlmostEqual(component, tension * direction, delta=1e-9)
                self.assertAlmostEqual(max(map(abs, sample["joint_forces"]["hinge"]["torque"])), 0, delta=1e-9)

    def test_constraints_and_springs_act_on_the_first_body(self):
        # A sled of 3 kg on a cable of 1 m swings from the horizontal; 3 a = weight + spring + cable.
        for row in self.rows(self.write("swing.toml", SWING), "--duration", 0.3, "--every", 0.1):
            with self.subTest(t=row["t[s]"]):
                x, z = row["links/sled/x[m]"], row["links/sled/z[m]"]
                length = math.hypot(x - 1, z + 2)
                pull = 10 * (length - 1)
                self.assertAlmostEqual(row["spring/coil/fx[N]"], -pull * (x - 1) / length, delta=1e-9)
                self.assertAlmostEqual(row["spring/coil/fz[N]"], -pull * (z + 2) / length, delta=1e-9)
                for axis, weight in (("x", 0), ("z", -3 * G)):
                    total = weight + row[f"spring/coil/f{axis}[N]"] + row[f"constraint/cable/f{axis}[N]"]
                    self.assertAlmostEqual(3 * row[f"links/sled/a{axis}[m/s^2]"], total, delta=1e-8)
                # The cable pulls along itself.
                self.assertAlmostEqual(row["constraint/cable/fx[N]"] * z, row["constraint/cable/fz[N]"] * x, delta=1e-7)

    def test_contacts_of_a_body_at_rest_carry_its_weight(self):
        last = self.rows(self.write("stack.toml", STACK), "--duration", 0.2)[-1]
        self.assertAlmostEqual(last["contacts/high/fz[N]"], G, delta=1e-6)
        self.assertAlmostEqual(last["contacts/low/fz[N]"], 2 * G, delta=1e-6)  # 3 g from below, g from above

    def test_they_are_those_of_inspect(self):
        scene, record = self.write("swing.toml", SWING), self.folder / "swing.twinrec"
        run = self.json_of("simulate", scene, "--duration", 0.2, "--forces", "--record", record)
        seen = self.json_of("inspect", record, "--at", 0.2)
        for mine, theirs in zip(run["samples"][-1]["forces"], seen["forces"], strict=True):
            self.assertEqual(mine["source"], theirs["source"])
            for a, b in zip(mine["on"], theirs["on"], strict=True):
                self.assertEqual(a["body"], b["body"])
                for p, q in zip(a["force"], b["force"]):
                    self.assertAlmostEqual(p, q, delta=1e-3 * (1 + abs(q)))  # inspect: of a step of 0.5 ms

    def test_accelerations_are_second_differences_of_positions(self):
        dt = 1e-4
        rows = self.rows(SLIDER_CRANK, "--duration", 0.03, "--every", dt)
        for before, now, after in zip(rows[::20], rows[1::20], rows[2::20]):
            for link in ("rod", "piston"):
                for axis in "xz":
                    x = f"links/{link}/{axis}[m]"
                    self.assertAlmostEqual(now[f"links/{link}/a{axis}[m/s^2]"],
                                           (before[x] - 2 * now[x] + after[x]) / dt**2, delta=0.02)

    def test_a_table_cannot_show_them(self):
        error = self.twinarm("simulate", self.write("swing.toml", SWING), "--forces", code=2).stderr
        self.assertIn("--forces: needs --json or --csv", error)


if __name__ == "__main__":
    main()
