#!/usr/bin/env python3
"""`twinarm map`: planes against closed forms, cells against `simulate`, kills, parts, faults.

    test_map_command.py PATH/TO/twinarm
"""
import json
import math
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from waiting import TIMEOUT  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ""

HINGE = ('<robot name="hinge"><link name="base"/><link name="arm"><inertial><mass value="1"/>'
         '<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.5"/></inertial></link>'
         '<joint name="hinge" type="continuous"><parent link="base"/><child link="arm"/>'
         '<axis xyz="0 0 1"/></joint></robot>')
INERTIA = 0.5
SCENE = """
duration = %(duration)g
gravity = [0, 0, 0]
[[robot]]
name = "hinge"
model = "hinge.urdf"
[[coupling]]
name = "pull"
type = "torsional"
measure = "joint"
link = "arm"
stiffness = 500
damping = %(damping)g
treatment = "%(treatment)s"
target = { q = { hinge = 0.01 } }
"""
ARM = "assets/scenes/tracking_map.toml"


class MapCommand(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="twinarm-map-"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "hinge.urdf").write_text(HINGE)

    def twinarm(self, *arguments, code=0, timeout=TIMEOUT):
        result = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                                timeout=timeout, cwd=ROOT)
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        return result

    def scene(self, treatment="explicit", damping=1.0, duration=20.0, name="scene.toml"):
        file = self.folder / name
        file.write_text(SCENE % {"treatment": treatment, "damping": damping, "duration": duration})
        return file

    def map(self, scene, *options, name="work.twinmap"):
        return json.loads(self.twinarm("map", scene, *options, "--work", self.folder / name,
                                       "--json").stdout)

    def faults(self, *arguments):
        return json.loads(self.twinarm("map", *arguments, "--json", code=2).stdout)["errors"]

    def refused(self, code, value, *arguments):
        """There is a fault of that code, which tells the value or the name."""
        faults = self.faults(*arguments)
        self.tells(faults, code, value)

    def tells(self, faults, code, value):
        self.assertTrue(any(f["code"] == code and value in
                            f'{f["file"]} {f["where"]}: {f["rule"]}; {f["remedy"]}' for f in faults),
                        (code, value, faults))


class Maps(MapCommand):
    # Stability against docs/coupling.md, section 4.

    seen = []  # names of work files

    def agrees_with(self, is_stable, treatment, *options, y="step:0.005:0.15:30"):
        plane = self.map(self.scene(treatment), "--x", "coupling.damping:0.5:20:6", "--y", y,
                         *options, name=f"{treatment}{len(self.seen)}.twinmap")
        self.seen.append(treatment)
        seen = set()
        for iy, h in enumerate(plane["y"]):
            for ix, b in enumerate(plane["x"]):
                verdicts = {is_stable(500 * h * h * m * m / INERTIA, b * h * m / INERTIA)
                            for m in (0.995, 1.005)}
                if len(verdicts) == 1:
                    seen |= verdicts
                    self.assertEqual(plane["values"][iy][ix], verdicts.pop(), (treatment, h, b))
        return plane, seen

    def test_the_edge_of_a_hinge_is_that_of_the_closed_form_for_each_treatment(self):
        _, seen = self.agrees_with(lambda a, b: a < 4 - 2 * b, "explicit")
        self.assertEqual(seen, {True, False})
        _, seen = self.agrees_with(lambda a, b: a < 4 + 2 * b, "semi-implicit")
        self.assertEqual(seen, {True, False})
        _, seen = self.agrees_with(lambda a, b: True, "implicit")
        self.assertEqual(seen, {True})

    def test_the_edge_of_other_integrators_is_that_of_their_polynomial(self):
        def by_polynomial(order):
            def is_stable(alpha, beta):
                root = complex(beta * beta / 4 - alpha) ** 0.5
                return all(abs(sum(z ** i / math.factorial(i) for i in range(order + 1))) < 1
                           for z in (-beta / 2 + root, -beta / 2 - root))
            return is_stable
        for name, order in (("rk4", 4), ("heun", 2)):
            _, seen = self.agrees_with(by_polynomial(order), "explicit", "--integrator", name)
            self.assertEqual(seen, {True, False})

    def test_the_curve_on_top_is_the_closed_form(self):
        plane, _ = self.agrees_with(lambda a, b: a < 4 - 2 * b, "explicit")
        self.assertEqual([c["name"] for c in plane["curves"]], ["semi-implicit Euler, start pose"])
        curve = plane["curves"][0]
        self.assertEqual(len(curve["x"]), 6)
        for b, h in zip(curve["x"], curve["y"]):
            z = b / (2 * math.sqrt(500 * INERTIA))
            wanted = 2 * (math.sqrt(1 + z * z) - z) / math.sqrt(500 / INERTIA)
            self.assertAlmostEqual(h / wanted, 1, delta=1e-3)

    # Each cell is a run of `twinarm simulate`.

    def test_cells_run_again_through_simulate_agree(self):
        axes = ["--x", "coupling.stiffness:1e4:1e6:16:log", "--y", "step:0.001:0.01:16:log",
                "--duration", 0.8]
        planes = {m: self.map(ARM, *axes, "--measure", m)["values"]
                  for m in ("stable", "max_error", "mean_error", "energy", "passivity")}
        random.seed(8)
        cells = random.sample([(ix, iy) for ix in range(16) for iy in range(16)], 50)
        stable = 0
        for ix, iy in cells:
            file = self.folder / f"cell{ix}-{iy}.twinrec"
            opened = json.loads(self.twinarm("map", ARM, *axes, "--cell", f"{ix},{iy}", "--record",
                                             file, "--json").stdout)
            words = opened["command"].split()
            self.assertEqual(words[:2], ["twinarm", "simulate"])
            run = json.loads(subprocess.run(
                [PROGRAM, *words[1:], "--every", str(opened["y"]), "--json"], capture_output=True,
                text=True, timeout=TIMEOUT, cwd=ROOT).stdout)
            created = sum(v for k, v in run["ledger"].items()
                          if k == "numerical" or k.endswith("/implicit"))
            if planes["stable"][iy][ix] == 0:
                self.assertTrue("post_mortem" in run or created > 100)
                self.assertIsNone(planes["max_error"][iy][ix])
                continue
            stable += 1
            errors = {}
            for sample in run["samples"]:
                twin = sample["targets"]["pull_arm1"]["q"]
                for joint in ("joint1", "joint2"):
                    e = abs(twin[joint] - sample["q"][joint])
                    errors.setdefault(joint, []).append((sample["t"], e))
            mean = max(sum((b[0] - a[0]) * (a[1] + b[1]) / 2 for a, b in zip(row, row[1:])) / 0.8
                       for row in errors.values())
            wanted = {"max_error": max(e for row in errors.values() for _, e in row),
                      "mean_error": mean, "energy": created}
            for measure, value in wanted.items():
                found = planes[measure][iy][ix]
                self.assertAlmostEqual(found, value, delta=1e-9 * max(1, abs(value)),
                                       msg=f"{measure} of {ix},{iy}")
                self.assertAlmostEqual(opened[measure], value, delta=1e-9 * max(1, abs(value)))
            self.assertLessEqual(planes["passivity"][iy][ix], 0)
        self.assertGreater(stable, 10)
        self.assertLess(stable, 50)

    def test_cells_side_by_side_are_those_that_run_one_by_one(self):
        for n, axes in enumerate((
                ["--x", "coupling.stiffness:1e4:1e6:9:log", "--y", "step:0.001:0.01:11:log"],
                ["--x", "coupling.delay:0:0.1:5", "--y", "coupling.speed:0.5:3:5"],
                ["--x", "coupling[1].point[0]:0.05:0.6:7", "--y", "coupling.damping:10:4000:7:log"])):
            for measure in ("stable", "max_error", "mean_error", "energy", "passivity"):
                planes = [self.map(ARM, *axes, "--duration", 0.6, "--measure", measure, *alone,
                                   name=f"{n}{alone}") for alone in ([], ["--alone"])]
                for row, other in zip(*(p["values"] for p in planes)):
                    for value, wanted in zip(row, other):
                        self.assertEqual(value is None, wanted is None)
                        if wanted is not None:
                            self.assertAlmostEqual(value, wanted, delta=1e-9 * max(1, abs(wanted)),
                                                   msg=f"{measure} {axes}")

    def test_a_cell_that_is_opened_has_a_recording_that_replays(self):
        file = self.folder / "cell.twinrec"
        self.twinarm("map", self.scene(duration=1), "--x", "coupling.damping:0.5:20:6", "--y",
                     "step:0.005:0.05:8", "--cell", "2,3", "--record", file)
        answer = json.loads(self.twinarm("replay", file, "--from", 0.3, "--json").stdout)
        self.assertTrue(answer["bit_exact"])

    # The same bytes, however they came about.

    def test_threads_parts_and_kills_change_no_byte(self):
        scene = self.scene(duration=0.3)
        axes = ["--x", "coupling.damping:0.5:20:40", "--y", "coupling.stiffness:10:1e5:35:log"]
        whole = self.folder / "whole.twinmap"
        text = self.twinarm("map", scene, *axes, "--work", whole, "--threads", 1, "--json").stdout
        other = self.twinarm("map", scene, *axes, "--work", self.folder / "b", "--threads", 3,
                             "--json").stdout
        self.assertEqual(other, text)
        self.assertEqual((self.folder / "b").read_bytes(), whole.read_bytes())
        parts = []
        for i in range(4):
            parts.append(self.folder / f"part{i}")
            self.twinarm("map", scene, *axes, "--tiles", 4, "--tile", i, "--work", parts[-1])
        joined = self.folder / "joined"
        random.seed(3)
        random.shuffle(parts)
        self.assertEqual(self.twinarm("map", "--merge", *parts, "--work", joined, "--json").stdout,
                         text)
        self.assertEqual(joined.read_bytes(), whole.read_bytes())

    def test_a_killed_map_goes_on_from_its_finished_cells(self):
        scene = self.scene(duration=1)
        axes = ["--x", "coupling.damping:0.5:20:64", "--y", "coupling.stiffness:10:1e5:32:log",
                "--alone"]  # slow enough to be struck
        command = [PROGRAM, "map", str(scene), *axes, "--json", "--work"]
        text = subprocess.run([*command, self.folder / "whole"], capture_output=True).stdout
        sizes = []
        for blow, code in ((signal.SIGKILL, -signal.SIGKILL), (signal.SIGINT, 130)):
            work = self.folder / "work"
            before = work.stat().st_size if work.exists() else 0
            process = subprocess.Popen([*command, work], stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE)
            deadline = time.time() + TIMEOUT
            while time.time() < deadline and process.poll() is None:
                if work.exists() and work.stat().st_size > before:
                    process.send_signal(blow)
                    break
                time.sleep(0.005)
            out, told = process.communicate(timeout=TIMEOUT)
            self.assertEqual(process.returncode, code, told)
            self.assertEqual(out, b"")
            if blow == signal.SIGINT:
                self.assertRegex(told.decode(), r"\d+ of 8 blocks of cells are finished")
            sizes.append(work.stat().st_size)
        whole = (self.folder / "whole").stat().st_size
        self.assertLess(sizes[0], sizes[1])
        self.assertLess(sizes[1], whole)
        again = subprocess.run([*command, self.folder / "work"], capture_output=True).stdout
        self.assertEqual(again, text)
        self.assertEqual((self.folder / "work").read_bytes(),
                         (self.folder / "whole").read_bytes())


class Faults(MapCommand):
    AXES = ("--x", "coupling[0].damping:0.5:20:3", "--y", "step:0.005:0.05:3")

    def test_paths_lead_to_any_number_of_the_scene(self):
        scene = self.scene(duration=0.1)
        for path, low, high in (("coupling[0].stiffness", 1, 2), ("coupling.pull.stiffness", 1, 2),
                                ("coupling.target.q.hinge", 0.1, 0.2), ("gravity[2]", -9, -1),
                                ("duration", 0.05, 0.1), ("step", 0.001, 0.01)):
            plane = self.map(scene, "--x", f"{path}:{low}:{high}:2", "--y",
                             "coupling.damping:0:1:2", "--measure", "max_error",
                             name=path + ".twinmap")
            self.assertEqual(plane["x"], [low, high])

    def test_axes_that_the_scene_has_not_are_told_with_the_nearest_names(self):
        scene = self.scene()
        for path, code, value in (
                ("couplng.stiffness", "path.unknown-key", "'coupling'"),
                ("coupling.stifness", "scene.unknown-key", "'stiffness'"),
                ("coupling[3].stiffness", "path.no-item", "3"),
                ("coupling.name", "path.no-number", "'pull'"),
                ("gravity", "path.no-number", "gravity[0]"),
                ("stepp", "scene.unknown-key", "'step'"),
                ("robot.q.joint1", "path.unknown-key", "'q'"), ("coupling..x", "path.form", "x")):
            self.refused(code, value, scene, "--x", f"{path}:1:2:3", "--y", "coupling.damping:0:1:2")

    def test_absurd_values_are_told_with_the_remedy(self):
        scene = self.scene()
        y = ("--y", "coupling.damping:0:1:2")
        for axis, code, value in (("coupling.stiffness:-5:10:4", "scene.negative", "-5"),
                                  ("step:0:1:4", "scene.not-positive", "0"),
                                  ("step:1e-8:0.01:4", "map.steps", "1e8"),
                                  ("step:1e-12:0.01:4", "run.too-many-steps", "1e10"),
                                  ("step:0.1:100:4", "map.steps", "100"),
                                  ("step:0.1:0.2:1", "axis.count", "4096"),
                                  ("step:0.1:0.2:2.5", "axis.count", "4096"),
                                  ("step:0:0.2:4:log", "axis.log-from-zero", "0"),
                                  ("step:-1:1:4:log", "axis.log-from-zero", "-1"),
                                  ("step:0.2:0.1:4", "axis.order", "0.2"),
                                  ("step:0.1:nan:4", "axis.number", "'nan'"),
                                  ("step:0.1:0.2:4:lag", "axis.scale", "'lag'"),
                                  ("step:0.1", "axis.form", "step:0.1"),
                                  ("coupling.damping:0:1:2", "map.same-axes", "--x")):
            self.refused(code, value, scene, "--x", axis, *y)
        told = self.faults(scene, "--x", "step:0:1:1", "--y", "y:5:3:2:log", "--measure", "max_eror")
        for code, value in (("axis.count", "4096"), ("axis.order", "5"),
                            ("map.measure", "'max_error'")):
            self.tells(told, code, value)
        self.refused("map.option-and-axis", "--step", scene, *self.AXES, "--step", 0.1)
        self.refused("map.no-scene", "hinge.urdf", self.folder / "hinge.urdf", *self.AXES)
        self.refused("map.coupling-unknown", "'pull'", scene, *self.AXES, "--of", "pul")
        self.refused("map.cell", "0,0 to 2,2", scene, *self.AXES, "--cell", "3,0", "--record",
                     self.folder / "x.twinrec")

    def test_files_of_another_map_are_refused_and_nothing_is_overwritten_without_force(self):
        scene = self.scene(duration=0.5)
        work, picture = self.folder / "work", self.folder / "map.svg"
        self.twinarm("map", scene, *self.AXES, "--work", work, "--svg", picture)
        kept = work.read_bytes()
        self.refused("file.exists", "--svg", scene, *self.AXES, "--work", work, "--svg", picture)
        axes = ("--x", "coupling[0].damping:0.5:21:3", *self.AXES[2:])
        told = self.faults(scene, *axes, "--work", work)
        for value in ("coupling[0].damping:0.5:20:3", "coupling[0].damping:0.5:21:3"):
            self.tells(told, "map.other-map", value)
        scene.write_text(scene.read_text().replace("500", "501"))
        told = self.faults(scene, *self.AXES, "--work", work)
        self.assertEqual([fault["code"] for fault in told], ["map.other-map"])
        self.tells(told, "map.other-map", "--force")
        self.assertEqual(work.read_bytes(), kept)
        self.twinarm("map", scene, *self.AXES, "--work", work, "--svg", picture, "--force")
        self.assertNotEqual(work.read_bytes(), kept)
        self.refused("file.unwritable", "/proc/none", scene, *self.AXES, "--csv", "/proc/none/map.csv")

    def test_a_merge_tells_parts_that_are_missing_foreign_or_damaged(self):
        scene = self.scene(duration=0.2)
        axes = ("--x", "coupling.damping:0.5:20:40", "--y", "step:0.005:0.05:20")
        parts = [self.folder / f"p{i}" for i in range(3)]
        for i, part in enumerate(parts):
            self.twinarm("map", scene, *axes, "--tiles", 3, "--tile", i, "--work", part)
        told = self.faults("--merge", parts[0], parts[2])
        for value in ("2 of 6", "1 4"):
            self.tells(told, "map.blocks-missing", value)
        self.twinarm("map", scene, *axes[:3], "step:0.005:0.04:20", "--tiles", 3, "--tile", 1,
                     "--work", parts[1], "--force")
        told = self.faults("--merge", *parts)
        for value in ("step:0.005:0.04:20", "step:0.005:0.05:20"):
            self.tells(told, "map.other-map", value)
        self.tells(told, "map.blocks-missing", "2 of 6")
        data = parts[2].read_bytes()
        parts[2].write_bytes(data.replace(b"\n32,", b"\nx,", 1))
        self.refused("map.row", "p2", "--merge", *parts)
        parts[2].write_bytes(data + data.splitlines()[-1] + b"\n")
        self.refused("map.row", "p2", "--merge", *parts)
        parts[2].write_bytes(data[:-100])
        self.refused("map.cut-short", "p2", "--merge", *parts)
        parts[2].write_text("twinarm map 1\nprogram 0.1.0\n\n")
        self.refused("map.old-file", "p2", "--merge", *parts)
        parts[2].write_text("hello")
        self.refused("map.file-form", "p2", "--merge", *parts)
        self.refused("map.part", "3 of 3", scene, *axes, "--tiles", 3, "--tile", 3)
        self.refused("map.part", "99", scene, *axes, "--tiles", 99, "--tile", 98)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
