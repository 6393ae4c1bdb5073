"""`twinarm map`: planes against closed forms, cells against `simulate`, kills, parts, faults."""
import json
import random
import signal

from map_command import ARM, INERTIA, MEASURES, MapCommand, is_stable_of_order
from program import main, run


class Maps(MapCommand):
    def test_cells_and_the_curve_on_top_are_those_of_the_closed_form_of_each_scheme(self):
        """docs/understand/stability_of_spring_dampers.md."""
        for discretization, options, is_stable in (("explicit", (), lambda a, b: a < 4 - 2 * b),
                                                   ("semi-implicit", (), lambda a, b: a < 4 + 2 * b),
                                                   ("implicit", (), lambda a, b: True),
                                                   ("explicit", ("--integrator", "rk4"), is_stable_of_order(4)),
                                                   ("explicit", ("--integrator", "heun"), is_stable_of_order(2))):
            with self.subTest(discretization, options=options):
                plane = self.map(self.scene(discretization), "--x", "coupling.damping:0.5:20:6", "--y",
                                 "step:0.005:0.15:30", *options, name=discretization + "".join(options))
                self.check_plane(plane, lambda h, b: is_stable(500 * h * h / INERTIA, b * h / INERTIA),
                                 has_edge=discretization != "implicit")
                if discretization == "explicit" and not options:
                    self.assertEqual([c["name"] for c in plane["curves"]], ["semi-implicit Euler, start pose"])

    def check_plane(self, plane, is_stable, has_edge):
        seen = set()
        for iy, h in enumerate(plane["y"]):
            for ix, b in enumerate(plane["x"]):
                verdicts = {is_stable(0.995 * h, b), is_stable(1.005 * h, b)}
                if len(verdicts) == 1:
                    seen |= verdicts
                    self.assertEqual(plane["values"][iy][ix], verdicts.pop(), (h, b))
        self.assertEqual(seen, {True, False} if has_edge else {True})
        if has_edge:
            curve = plane["curves"][0]
            self.assertEqual(len(curve["x"]), 6)
            for b, h in zip(curve["x"], curve["y"]):
                self.assertEqual((is_stable(0.998 * h, b), is_stable(1.002 * h, b)), (True, False), (h, b))

    # Each cell is a run of `twinarm simulate`.

    def test_cells_run_again_through_simulate_agree(self):
        axes = ["--x", "coupling.stiffness:1e4:1e6:16:log", "--y", "step:0.001:0.01:16:log", "--duration", 0.8]
        planes = {m: self.map(ARM, *axes, "--measure", m)["values"] for m in MEASURES}
        random.seed(8)
        cells = random.sample([(ix, iy) for ix in range(16) for iy in range(16)], 50)
        stable = 0
        for ix, iy in cells:
            file = self.folder / f"cell{ix}-{iy}.twinrec"
            opened = self.json_of("map", ARM, *axes, "--cell", f"{ix},{iy}", "--record", file)
            words = opened["command"].split()
            self.assertEqual(words[:2], ["twinarm", "simulate"])
            again = json.loads(run(*words[1:], "--every", opened["y"], "--json").stdout)
            created = sum(v for k, v in again["energy_balance"].items() if k == "numerical" or k.endswith("/implicit"))
            if planes["stable"][iy][ix] == 0:
                self.assertTrue("post_mortem" in again or created > 100)
                self.assertIsNone(planes["max_error"][iy][ix])
                continue
            stable += 1
            errors = {}
            for sample in again["samples"]:
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
                self.assertAlmostEqual(found, value, delta=1e-9 * max(1, abs(value)), msg=f"{measure} of {ix},{iy}")
                self.assertAlmostEqual(opened[measure], value, delta=1e-9 * max(1, abs(value)))
            self.assertLessEqual(planes["passivity"][iy][ix], 0)
        self.assertGreater(stable, 10)
        self.assertLess(stable, 50)

    def test_cells_side_by_side_are_those_that_run_one_by_one(self):
        for axes in (["--x", "coupling.stiffness:1e4:1e6:9:log", "--y", "step:0.001:0.01:11:log"],
                     ["--x", "coupling.delay:0:0.1:5", "--y", "coupling.speed:0.5:3:5"],
                     ["--x", "coupling[1].point[0]:0.05:0.6:7", "--y", "coupling.damping:10:4000:7:log"]):
            with self.subTest(axes):
                self.check_both_ways(ARM, *axes, "--duration", 0.6)

    def test_a_cell_that_is_opened_has_a_recording_that_replays(self):
        file = self.folder / "cell.twinrec"
        self.twinarm("map", self.scene(duration=1), "--x", "coupling.damping:0.5:20:6", "--y",
                     "step:0.005:0.05:8", "--cell", "2,3", "--record", file)
        self.assertTrue(self.json_of("replay", file, "--from", 0.3)["bit_exact"])

    # The same bytes, however they came about.

    def test_threads_parts_and_kills_change_no_byte(self):
        scene = self.scene(duration=0.3)
        axes = ["--x", "coupling.damping:0.5:20:40", "--y", "coupling.stiffness:10:1e5:35:log"]
        whole = self.folder / "whole.twinmap"
        text = self.twinarm("map", scene, *axes, "--checkpoint", whole, "--threads", 1, "--json").stdout
        other = self.twinarm("map", scene, *axes, "--checkpoint", self.folder / "b", "--threads", 3, "--json").stdout
        self.assertEqual(other, text)
        self.assertEqual((self.folder / "b").read_bytes(), whole.read_bytes())
        parts = []
        for i in range(4):
            parts.append(self.folder / f"part{i}")
            self.twinarm("map", scene, *axes, "--jobs", 4, "--job", i, "--checkpoint", parts[-1])
        joined = self.folder / "joined"
        random.seed(3)
        random.shuffle(parts)
        self.assertEqual(self.twinarm("map", "--merge", *parts, "--checkpoint", joined, "--json").stdout, text)
        self.assertEqual(joined.read_bytes(), whole.read_bytes())

    def test_a_killed_map_goes_on_from_its_finished_cells(self):
        scene = self.scene(duration=1)
        axes = ["--x", "coupling.damping:0.5:20:64", "--y", "coupling.stiffness:10:1e5:32:log",
                "--no-simd"]  # slow enough to be killed
        command = ["map", scene, *axes, "--json", "--checkpoint"]
        text = self.twinarm(*command, self.folder / "whole").stdout
        sizes, work = [], self.folder / "work"
        for blow, code in ((signal.SIGKILL, -signal.SIGKILL), (signal.SIGINT, 130)):
            before = work.stat().st_size if work.exists() else 0
            out, reported = self.interrupted(*command, work, blow=blow, code=code,
                                             is_ready=lambda _: work.exists() and work.stat().st_size > before)
            self.assertEqual(out, "")
            if blow == signal.SIGINT:
                self.assertRegex(reported, r"\d+ of 8 blocks of cells are finished")
            sizes.append(work.stat().st_size)
        whole = (self.folder / "whole").stat().st_size
        self.assertLess(sizes[0], sizes[1])
        self.assertLess(sizes[1], whole)
        self.assertEqual(self.twinarm(*command, work).stdout, text)
        self.assertEqual(work.read_bytes(), (self.folder / "whole").read_bytes())


class Faults(MapCommand):
    AXES = ("--x", "coupling[0].damping:0.5:20:3", "--y", "step:0.005:0.05:3")

    def test_paths_lead_to_any_number_of_the_scene(self):
        scene = self.scene(duration=0.1)
        for path, low, high in (("coupling[0].stiffness", 1, 2), ("coupling.pull.stiffness", 1, 2),
                                ("coupling.target.q.hinge", 0.1, 0.2), ("gravity[2]", -9, -1),
                                ("duration", 0.05, 0.1), ("step", 0.001, 0.01)):
            plane = self.map(scene, "--x", f"{path}:{low}:{high}:2", "--y", "coupling.damping:0:1:2", "--measure",
                             "max_error", name=path + ".twinmap")
            self.assertEqual(plane["x"], [low, high])

    def test_files_of_another_map_are_refused_and_nothing_is_overwritten_without_force(self):
        scene = self.scene(duration=0.5)
        work, picture = self.folder / "work", self.folder / "map.svg"
        self.twinarm("map", scene, *self.AXES, "--checkpoint", work, "--svg", picture)
        kept = work.read_bytes()
        self.refused("file.exists", "--svg", scene, *self.AXES, "--checkpoint", work, "--svg", picture)
        axes = ("--x", "coupling[0].damping:0.5:21:3", *self.AXES[2:])
        reported = self.faults(scene, *axes, "--checkpoint", work)
        for value in ("coupling[0].damping:0.5:20:3", "coupling[0].damping:0.5:21:3"):
            self.tells(reported, "map.other-map", value)
        scene.write_text(scene.read_text().replace("500", "501"))
        reported = self.faults(scene, *self.AXES, "--checkpoint", work)
        self.assertEqual([fault["code"] for fault in reported], ["map.other-map"])
        self.tells(reported, "map.other-map", "--force")
        self.assertEqual(work.read_bytes(), kept)
        self.twinarm("map", scene, *self.AXES, "--checkpoint", work, "--svg", picture, "--force")
        self.assertNotEqual(work.read_bytes(), kept)
        self.refused("file.unwritable", "/proc/none", scene, *self.AXES, "--csv", "/proc/none/map.csv")

    def test_a_merge_tells_parts_that_are_missing_foreign_or_damaged(self):
        scene = self.scene(duration=0.2)
        axes = ("--x", "coupling.damping:0.5:20:40", "--y", "step:0.005:0.05:20")
        parts = [self.folder / f"p{i}" for i in range(3)]
        for i, part in enumerate(parts):
            self.twinarm("map", scene, *axes, "--jobs", 3, "--job", i, "--checkpoint", part)
        reported = self.faults("--merge", parts[0], parts[2])
        for value in ("2 of 6", "1 4"):
            self.tells(reported, "map.blocks-missing", value)
        self.twinarm("map", scene, *axes[:3], "step:0.005:0.04:20", "--jobs", 3, "--job", 1,
                     "--checkpoint", parts[1], "--force")
        reported = self.faults("--merge", *parts)
        for value in ("step:0.005:0.04:20", "step:0.005:0.05:20"):
            self.tells(reported, "map.other-map", value)
        self.tells(reported, "map.blocks-missing", "2 of 6")
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


if __name__ == "__main__":
    main()
