"""`twinarm map`: what its axes, measures, curves and files say, each against something of its own."""
import csv
import json

from map_command import ARM, MEASURES, MapCommand
from program import ROOT, data, main, run


class Planes(MapCommand):
    def errors(self, opened, y):
        """By joint, the largest |q_K - q_D| of the run of an opened cell."""
        samples = json.loads(run(*opened["command"].split()[1:], "--every", y, "--json").stdout)["samples"]
        return {joint: max(abs(s["targets"]["pull_arm1"]["q"][joint] - s["q"][joint])
                           for s in samples) for joint in ("joint1", "joint2")}

    def test_axes_are_spaced_as_they_say(self):
        plane = self.map(self.scene(duration=0.05), "--x", "coupling.stiffness:10:1e4:4:log", "--y",
                         "coupling.damping:0:1:5")
        for value, wanted in zip(plane["x"], (10, 100, 1000, 10000)):
            self.assertAlmostEqual(value / wanted, 1, delta=1e-14)
        self.assertEqual((plane["x"][0], plane["x"][-1]), (10, 10000))
        self.assertEqual(plane["y"], [0, 0.25, 0.5, 0.75, 1])

    def test_a_table_holds_all_measures_where_json_has_them(self):
        axes = ("--x", "coupling.damping:0.5:20:3", "--y", "step:0.01:0.09:2", "--duration", 2)
        scene, table = self.scene(), self.folder / "map.csv"
        planes = {m: self.map(scene, *axes, "--measure", m) for m in MEASURES}
        self.twinarm("map", scene, *axes, "--csv", table, "--checkpoint", self.folder / "work.twinmap")
        rows = list(csv.reader(table.read_text().splitlines()))
        self.assertEqual(rows[0], ["coupling.damping[N m s/rad]", "step[s]", "stable[1]", "max_error[rad]",
                                   "mean_error[rad]", "energy[J]", "passivity[J]"])
        self.assertEqual({v for row in planes["stable"]["values"] for v in row}, {0, 1})
        cells = [(iy, ix) for iy in range(2) for ix in range(3)]
        for (iy, ix), row in zip(cells, rows[1:], strict=True):
            wanted = [planes["stable"]["x"][ix], planes["stable"]["y"][iy],
                      *(planes[m]["values"][iy][ix] for m in MEASURES)]
            self.assertEqual([float(v) if v else None for v in row], wanted)

    def test_the_curve_of_the_worst_pose_is_the_lowest_of_the_poses_that_the_twin_passes(self):
        axes = ("--x", "coupling.stiffness:1e5:1e6:2:log", "--y", "step:1e-3:1e-2:3:log", "--duration", 0.05)
        text = (ROOT / ARM).read_text()
        starts, worst = [], None
        for bend in (-0.7853981633974483, -0.39269908169872414, 0, 0.39269908169872414):
            scene = self.folder / f"pose{len(starts)}.toml"
            scene.write_text(text.replace("joint2 = -0.7853981633974483", f"joint2 = {bend:g}.0" if bend == 0
                                          else f"joint2 = {bend}").replace("duration = 3\n", ""))
            curves = self.map(scene, *axes[:-1], 3, name=f"pose{len(starts)}")["curves"]
            starts.append(curves[0]["y"])
            if worst is None:
                worst = curves[1]
        self.assertEqual(worst["name"], "the same, worst pose of the target")
        for column, h in enumerate(worst["y"]):
            least = min(start[column] for start in starts)
            self.assertLess(least, 0.999 * starts[0][column])
            self.assertLess(h, 1.001 * least)
            self.assertGreater(h, 0.98 * least)

    def test_the_geometric_limit_is_that_of_the_hinge_and_the_two_radii(self):
        self.write("slider.urdf", data("slider.urdf"))
        scene = self.write("slider.toml", data("slider.toml"))
        plane = self.map(scene, "--x", "step:0.005:0.02:3", "--y", "coupling.stiffness:1e3:1e7:5:log")
        curve = next(c for c in plane["curves"] if c["name"].startswith("geometric limit"))
        r, R = 0.2, 1.0
        inertia = 0.5 + 0.01 + r * r
        self.assertEqual(len(curve["x"]), 3)
        for h, k in zip(curve["x"], curve["y"]):  # docs/understand/stability_of_spring_dampers.md, with b = 0
            self.assertAlmostEqual(k / (4 * inertia / (h * h * r * (R - 2 * r))), 1, delta=3e-3)

    def test_the_error_is_that_of_the_joint_where_it_is_largest(self):
        axes = ("--x", "coupling[0].stiffness:500:5e4:2:log", "--y",
                "coupling[1].stiffness:500:5e4:2:log", "--duration", 0.6)
        planes = self.check_both_ways(ARM, *axes)
        led = set()
        for ix, iy in ((0, 0), (0, 1), (1, 0), (1, 1)):
            opened = self.json_of("map", ARM, *axes, "--cell", f"{ix},{iy}", "--record",
                                  self.folder / f"{ix}{iy}.twinrec")
            errors = self.errors(opened, 0.001)
            led.add(max(errors, key=errors.get))
            for found in (planes["max_error"][iy][ix], opened["max_error"]):
                self.assertAlmostEqual(found, max(errors.values()), delta=1e-9)
        self.assertEqual(led, {"joint1", "joint2"})  # or nothing was tried

    def test_of_names_the_coupling_whose_joints_are_measured(self):
        scene = self.folder / "rest.toml"
        scene.write_text((ROOT / ARM).read_text().replace(
            'target = "paper"', "target = { q = { joint1 = 1.58, joint2 = -0.6 } }"))
        axes = ("--x", "coupling.stiffness:2e4:3e4:2", "--y", "coupling.damping:400:500:2",
                "--duration", 0.1, "--measure", "max_error")
        one = self.map(scene, *axes, "--of", "pull_arm1", name="one")["values"]
        two = self.map(scene, *axes, "--of", "pull_arm2", name="two")["values"]
        for row, other in zip(one, two):
            for first, second in zip(row, other):
                self.assertLess(first, 0.1)  # joint 1 alone carries arm1
                self.assertGreaterEqual(second, 0.185)  # joint 2 is so far off at the start

    def test_implicit_couplings_take_energy_and_it_is_counted(self):
        planes = self.check_both_ways(self.scene("implicit", duration=2), "--x",
                                      "coupling.damping:0.1:2:3", "--y", "step:0.01:0.05:3")
        for row in planes["energy"]:
            for value in row:
                self.assertLess(value, -1e-3 * 0.5 * 500 * 0.01 ** 2)

    def test_cells_that_meet_a_joint_limit_feel_it(self):
        self.write("hinge.urdf", data("hinge.urdf").replace('"continuous"', '"revolute"').replace(
            '<axis xyz="0 0 1"/>', '<axis xyz="0 0 1"/><limit lower="-0.012" upper="0.012" effort="9" velocity="9"/>'))
        for side in ("0.01", "-0.01"):
            scene = self.scene(duration=1, name=f"limit{side}.toml")
            scene.write_text(scene.read_text().replace("hinge = 0.01", f"hinge = {side}"))
            planes = self.check_both_ways(scene, "--x", "coupling.damping:0.1:60:3", "--y", "step:0.001:0.002:2")
            self.assertLess(planes["mean_error"][0][0], 0.004)  # free, it would swing by 0.01

    def test_couplings_that_see_their_twin_each_in_its_own_time_are_run_as_they_are(self):
        self.check_both_ways(ARM, "--x", "coupling[0].delay:0:0.1:3", "--y", "coupling[0].speed:1:2:2",
                             "--duration", 0.3)

    def test_files_of_another_run_are_refused_whatever_differs(self):
        scene = self.scene(duration=0.1)
        axes = ("--x", "coupling.damping:0.5:20:3", "--y", "coupling.stiffness:100:500:3")
        work = self.folder / "work"
        self.twinarm("map", scene, *axes, "--checkpoint", work)
        for option, value in (("--duration", 0.2), ("--step", 0.002), ("--integrator", "rk4"), ("--of", "pull")):
            reported = self.faults(scene, *axes, option, value, "--checkpoint", work)
            self.assertEqual({fault["code"] for fault in reported}, {"map.other-map"}, option)
        self.refused("map.other-map", "cells", scene, *axes, "--no-simd", "--checkpoint", work)
        self.assertIn("no whole step", str(self.faults(scene, *axes[:2], "--y", "step:0.05:100:4")))

    def test_parts_that_contradict_each_other_are_not_joined(self):
        scene = self.scene(duration=0.1)
        axes = ("--x", "coupling.damping:0.5:20:3", "--y", "coupling.stiffness:100:500:3")
        a, b = self.folder / "a", self.folder / "b"
        self.twinarm("map", scene, *axes, "--checkpoint", a)
        *rows, last = a.read_text().splitlines()
        cell = last.split(",")
        self.assertEqual(len(cell), 2 + len(MEASURES))
        b.write_text("\n".join([*rows, ",".join([*cell[:-2], "0.25", cell[-1]])]) + "\n")
        self.twinarm("map", "--merge", b)
        self.refused("map.blocks", str(b), "--merge", a, b)


if __name__ == "__main__":
    main()
