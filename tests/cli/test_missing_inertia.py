"""Robots whose files give no inertia, or only some: kinematics, and the options that make their dynamics run."""
import collections
import csv
import json

from program import ROOT, main, run
from robot_command import RobotCommand, joint, link, robot

BOX = '<collision><origin xyz="0.5 0 0"/><geometry><box size="1 0.2 0.1"/></geometry></collision>'
BARE = robot('<link name="base"/>', f'<link name="rod">{BOX}</link>', '<link name="tip"/>',
             joint("hinge", "continuous", "base", "rod", axis="0 0 1"),
             joint("wrist", "continuous", "rod", "tip", xyz="1 0 0", axis="0 0 1"))
# About the hinge, of a box of 10 kg at 500 kg/m^3.
ROD = 10 * (1 + 0.2 ** 2) / 12 + 10 * 0.5 ** 2
# Codes of files that are no URDF robots, or incomplete ones.
MALFORMED = {"robot.link-unknown", "robot.two-roots", "robot.two-parents", "robot.loop", "robot.empty", "robot.limits",
             "robot.mimic-unknown", "urdf.xml", "urdf.joint-type", "urdf.limits-missing", "urdf.number", "urdf.twice"}


def ball(mass):
    return 0.4 * mass * (3 * mass / (4 * 3.141592653589793 * 1000)) ** (2 / 3)


class MissingInertia(RobotCommand):
    command = "dynamics"

    def test_kinematics_need_no_masses(self):
        answer = self.answer(BARE, "--kinematics", state={"q": {"hinge": 1.5707963267948966}})
        self.assertEqual(answer["joints"], ["hinge", "wrist"])
        self.close(answer["links"]["tip"]["position"], [0, 1, 0])
        self.assertNotIn("mass_matrix", answer)

    def test_a_picture_of_the_start_needs_no_masses(self):
        picture = self.folder / "bare.png"
        done = run("render", self.write("bare.urdf", BARE), "--png", picture, "--size", "64x48")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(picture.exists())

    def test_dynamics_of_joints_that_move_nothing_are_refused_with_the_options_that_help(self):
        faults = self.errors(BARE)
        self.assertEqual(len(faults), 2)
        for fault in faults:
            self.assertIn("or give --density 1000 (of its shapes), or --min-mass 0.001", fault)

    def test_a_density_gives_links_the_inertia_of_their_shapes_and_a_mass_makes_balls_of_the_others(self):
        answer = self.answer(BARE, "--density", 500, "--min-mass", 0.01)
        M = answer["mass_matrix"]
        self.close(answer["mass"], 10.02)  # also of the base
        self.close(M[0][0], ROD + 0.01 + ball(0.01))
        self.close([M[0][1], M[1][1]], [ball(0.01), ball(0.01)])
        self.assertEqual(len(self.errors(BARE, "--density", 500)), 1)  # the tip has no shape

    def test_a_mass_without_inertia_is_refused_and_with_a_density_is_kept(self):
        heavy = BARE.replace(BOX, '<inertial><origin xyz="0.5 0 0"/><mass value="20"/></inertial>' + BOX)
        (fault,) = self.errors(heavy)
        self.assertIn("<inertial> has no <inertia>", fault)
        self.assertIn("or give --density", fault)
        result = self.run_it(heavy, "--density", 500, "--min-mass", 0.01, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.close(json.loads(result.stdout)["mass_matrix"][0][0], 2 * ROD + 0.01 + ball(0.01))

    def test_a_mimic_of_a_fixed_joint_has_no_effect(self):
        frozen = robot('<link name="base"/>', link("a"), link("b"), joint("ja", "continuous", "base", "a"),
                       joint("jb", "fixed", "a", "b", more='<mimic joint="ja"/>'))
        answer = self.answer(frozen)
        self.assertEqual(answer["joints"], ["ja"])
        self.assertTrue(any("its <mimic> has no effect" in warning for warning in answer["warnings"]))

    def test_values_that_are_not_positive_are_refused_and_a_scene_has_its_own(self):
        faults = self.errors(BARE, "--density", 0, "--min-mass", -1)
        self.assertEqual(len(faults), 2)
        scene = self.write("scene.toml", '[[body]]\nname = "b"\nfixed = true\nshape = {sphere = {radius = 1}}\n')
        done = run("simulate", scene, "--duration", 1, "--density", 1000)
        self.assertEqual(done.returncode, 2)
        self.assertIn("applies to a URDF only", done.stderr.replace("apply", "applies"))

    def test_a_recording_keeps_the_options(self):
        file = self.folder / "bare.twinrec"
        done = run("simulate", self.write("bare.urdf", BARE), "--duration", 0.1, "--density", 500, "--min-mass", 0.01,
                   "--record", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(run("replay", file).returncode, 0)


class PublicRobots(RobotCommand):
    """The table of scripts/check/public_robots."""

    def test_it_lists_many_robots_of_many_repositories_and_the_refused_ones_are_malformed(self):
        with (ROOT / "tests/collision/import/urdf/public_robots.tsv").open(encoding="utf-8") as text:
            rows = list(csv.DictReader(text, delimiter="\t"))
        self.assertGreaterEqual(len(rows), 500)
        self.assertGreaterEqual(len({row["repository"] for row in rows}), 20)
        refused = collections.Counter(row["kinematics"] for row in rows if row["kinematics"] != "ok")
        well_formed = len(rows) - sum(count for code, count in refused.items() if code in MALFORMED)
        loaded = sum(row["kinematics"] == "ok" for row in rows)
        self.assertGreaterEqual(loaded, 0.99 * well_formed, refused)
        for row in rows:  # those that load have an option that makes them run
            if row["kinematics"] == "ok":
                self.assertIn(row["dynamics"], ("ok", "--density", "--min-mass", "--density --min-mass"), row)


if __name__ == "__main__":
    main()
