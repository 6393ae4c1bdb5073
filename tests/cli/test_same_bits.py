"""The same input gives the same bits: today's as those in the table, and whatever the number of threads."""
import os
import pathlib
import re
import subprocess
import tempfile
import tomllib
import unittest

import golden_hashes
import program
from golden_hashes import SCENES, read_table
from program import ROOT, ProgramTest, main

MAP = ["assets/scenes/tracking_map.toml", "--x", "coupling.stiffness:1e4:1e6:40:log", "--y",
       "step:0.002:0.01:20:log", "--duration", "0.5"]


class Table(unittest.TestCase):
    def test_each_scene_is_in_the_table_and_no_other(self):
        self.assertEqual(sorted(read_table()), [scene.stem for scene in SCENES])

    def test_what_the_lab_offers_is_in_the_table(self):
        gallery = tomllib.loads((ROOT / "assets/scenes/gallery/gallery.toml").read_text())
        files = {pathlib.Path(scene["file"]).stem for scene in gallery["scene"]}
        self.assertTrue(files)
        self.assertEqual(files - set(read_table()), set())

    def test_each_scene_has_after_its_steps_the_hash_that_it_had(self):
        with tempfile.TemporaryDirectory() as folder:
            for scene in SCENES:
                with self.subTest(scene=scene.stem):
                    row = read_table()[scene.stem]
                    self.assertEqual(golden_hashes.golden(program.PROGRAM, scene, row["steps"], folder), row["hash"],
                                     "are these other motions on purpose? then scripts/check/same_bits --renew")


class Machines(unittest.TestCase):
    def agree(self, name, *environments):
        row = read_table()[name]
        with tempfile.TemporaryDirectory() as folder:
            hashes = {golden_hashes.golden(program.PROGRAM, ROOT / f"assets/scenes/{name}.toml", row["steps"], folder,
                                           dict(os.environ, **more)) for more in environments}
        self.assertEqual(len(hashes), 1, name)

    def test_registers_of_256_and_of_512_bits_give_the_same_bits(self):
        for name in ("puma_under_hand", "four_bar", "study_e3"):
            self.agree(name, {"TWINARM_ISA": "v3"}, {"TWINARM_ISA": "v4"})

    def test_no_mathematical_function_is_that_of_the_c_library(self):
        listed = (ROOT / "scripts/cmake/libm.cmake").read_text().split("set(functions ")[1].split(")")[0].split()
        self.assertIn("sincos", listed)
        for file in (program.PROGRAM, *pathlib.Path(program.PROGRAM).parent.glob("twinarm_*.so")):
            used = subprocess.run(["nm", "--dynamic", "--undefined-only", file], check=True, capture_output=True,
                                  text=True).stdout
            self.assertEqual(set(re.findall(r" U (\w+)", used)) & set(listed), set(), file)


class Threads(ProgramTest):
    def same(self, results):
        for result in results[1:]:
            self.assertEqual(result, results[0])

    def test_a_map_has_the_same_bytes_with_one_two_and_three_threads(self):
        for way in ([], ["--no-simd"]):
            reported, files = [], []
            for threads in (1, 2, 3):
                file = self.folder / f"{threads}{len(way)}"
                reported.append(self.json_of("map", *MAP, *way, "--threads", threads, "--checkpoint", file, "--csv",
                                             f"{file}.csv"))
                files.append((file.read_bytes(), pathlib.Path(f"{file}.csv").read_bytes()))
            self.same(reported)
            self.same(files)

    def test_a_picture_has_the_same_bytes_with_none_one_and_three_threads_of_mesa(self):
        pictures = []
        for threads in (0, 1, 3):  # 0: the painter's own
            file = self.folder / f"{threads}.png"
            self.twinarm("render", "assets/scenes/robot_beside_obstacles.toml", "--png", file, "--at", 0.5, "--size",
                         "320x200", "--show", "all", env=dict(os.environ, LP_NUM_THREADS=str(threads)))
            pictures.append(file.read_bytes())
        self.same(pictures)

    def test_compare_finds_the_same_numbers_on_one_processor_and_on_all(self):
        reported = []
        for processors in ({min(os.sched_getaffinity(0))}, None):
            pinned = (lambda: os.sched_setaffinity(0, processors)) if processors else None  # fewer threads
            answer = self.json_of("compare", "A1", "A2", "B1", "C2", "--integrator", "rk4,verlet", preexec_fn=pinned)
            for case in answer["cases"]:
                case.pop("seconds")
                for lane in case["configurations"]:
                    lane.pop("seconds")
            reported.append(answer)
        self.assertGreater(len(reported[0]["cases"]), 2)
        self.same(reported)


if __name__ == "__main__":
    main()
