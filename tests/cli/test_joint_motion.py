"""Joints whose motion over time is given, against inverse dynamics in closed form."""
import math

from program import ProgramTest, main
from robot_command import HINGE, HINGE_INERTIA

SCENE = """step = 0.0005
integrator = "{integrator}"
[[robot]]
name = "arm"
model = "arm.urdf"
[[constraint]]
name = "motor"
type = "motion"
a = "arm/hinge"
position = "{position}"
"""


class JointMotion(ProgramTest):
    def scene(self, position="0.3 + 0.5 * sin(2[1/s] * t)", integrator="rk4"):
        self.write("arm.urdf", HINGE)
        return self.write("motion.toml", SCENE.format(position=position, integrator=integrator))

    def test_the_joint_follows_the_formula(self):
        for integrator, close in (("rk4", 1e-9), ("semi-implicit", 2e-3), ("dopri5", 1e-9)):
            run = self.json_of("simulate", self.scene(integrator=integrator), "--duration", 1.3)
            with self.subTest(integrator):
                last = run["samples"][-1]
                self.assertAlmostEqual(last["q"]["hinge"], 0.3 + 0.5 * math.sin(2.6), delta=close)
                self.assertAlmostEqual(last["qd"]["hinge"], math.cos(2.6), delta=close)

    def test_the_work_of_the_motor_is_the_change_of_energy(self):
        run = self.json_of("simulate", self.scene(), "--duration", 1.3)
        gained = 0.5 * HINGE_INERTIA * (math.cos(2.6)**2 - 1)
        self.assertAlmostEqual(run["energy_balance"]["constraint/motor"], gained, delta=1e-6)

    def test_the_force_of_the_motor_is_a_column(self):
        text = self.twinarm("simulate", self.scene(), "--duration", 1.3, "--csv", "--forces").stdout
        last = dict(zip(text.splitlines()[0].split(","), map(float, text.splitlines()[-1].split(","))))
        torque = -HINGE_INERTIA * 2 * math.sin(2.6)  # inertia times f''
        self.assertAlmostEqual(last["constraint/motor[N m]"], torque, delta=1e-9)

    def test_a_bad_motion_is_refused_with_a_remedy(self):
        for position, words in (("2[m] * t", "at character"), ("t", "at character"), ("sin(2 * t", "at character"),
                                ("q * 2", "q")):
            error = self.twinarm("simulate", self.scene(position), code=2).stderr
            with self.subTest(position):
                self.assertIn("motion.toml:", error)
                self.assertIn("position", error)
                self.assertIn(words, error)


if __name__ == "__main__":
    main()
