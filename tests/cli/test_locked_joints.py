"""lock = [..] of a scene's robot: as if the joint were fixed where it starts."""
import math

from program import ProgramTest, main
from robot_command import joint, link, robot

SCENE = '[[robot]]\nname = "arm"\nmodel = "arm.urdf"\nq = { first = 0.3%s }\n%s\n'


class LockedJoints(ProgramTest):
    def simulate(self, urdf, q, keys, code=0):
        self.write("arm.urdf", urdf)
        scene = self.write("scene.toml", SCENE % (q, keys))
        return self.json_of("simulate", scene, "--duration", 0.4, code=code)

    def arm(self, second):
        return robot('<link name="base"/>', link("upper"), link("lower"), link("tip"),
                     joint("first", "continuous", "base", "upper", axis="0 1 0"), second,
                     joint("third", "continuous", "lower", "tip", xyz="0 0 -0.7", axis="1 0 0"))

    def test_a_locked_joint_is_a_fixed_one_where_it_starts(self):
        place = {"xyz": "0.1 0.2 -0.5", "rpy": "0.3 -0.4 0.5"}
        turns = joint("second", "continuous", "upper", "lower", axis="0 0 1", **place)
        slides = joint("second", "prismatic", "upper", "lower", axis="0 0 1", **place)
        R = rotation_of(0.3, -0.4, 0.5)
        moved = [p + 0.25 * R[i][2] for i, p in enumerate((0.1, 0.2, -0.5))]
        # About its own z axis, the last of the three turns' inner one: R Rz(q).
        c, s = math.cos(0.25), math.sin(0.25)
        Rq = [[R[i][0] * c + R[i][1] * s, -R[i][0] * s + R[i][1] * c, R[i][2]] for i in range(3)]
        roll, pitch = math.atan2(Rq[2][1], Rq[2][2]), math.asin(-Rq[2][0])
        yaw = math.atan2(Rq[1][0], Rq[0][0])
        fixed_turn = joint("second", "fixed", "upper", "lower", xyz=place["xyz"], rpy=f"{roll!r} {pitch!r} {yaw!r}")
        fixed_slide = joint("second", "fixed", "upper", "lower", xyz=" ".join(map(repr, moved)), rpy=place["rpy"])
        for free, fixed in ((turns, fixed_turn), (slides, fixed_slide)):
            locked = self.simulate(self.arm(free), ", second = 0.25", 'lock = ["second"]')
            wanted = self.simulate(self.arm(fixed), "", "")
            self.assertEqual(locked["joints"], ["first", "third"])
            for key, value in wanted["samples"][-1]["q"].items():
                self.assertAlmostEqual(locked["samples"][-1]["q"][key], value, delta=1e-12)
            self.assertGreater(abs(wanted["samples"][-1]["q"]["third"]), 0.01)

    def test_what_cannot_be_locked_is_reported(self):
        turns = joint("second", "continuous", "upper", "lower", axis="0 0 1")
        for keys, words in (('lock = ["secnd"]', "did you mean 'second'"),
                            ('lock = "second"', "must be a list of joints"),
                            ('lock = ["second"]\nqd = { second = 1 }', "has a velocity")):
            reported = self.simulate(self.arm(turns), "", keys, code=2)["errors"]
            self.assertTrue(any(words in e["problem"] + e["fix"] for e in reported), reported)


def rotation_of(roll, pitch, yaw):
    """Rz(yaw) Ry(pitch) Rx(roll), as URDF has it."""
    cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    return [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr], [-sp, cp * sr, cp * cr]]


if __name__ == "__main__":
    main()
