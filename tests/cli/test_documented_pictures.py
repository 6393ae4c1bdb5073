"""A committed picture of docs/pictures is what its script makes.

Found: stills that scripts/generate/pictures now makes visibly different (another scene, overlay, legend or camera);
films whose options or input files have changed; layers that are drawn otherwise than CMake has them; pictures of
no script; too many bytes. Not found: a change of the program that only a film shows; an outdated lab.png (made by
hand) or map_throughput.png (a measurement). Drawings of lessons: scripts/check/lessons. Made again are zwidth and the
stills of 640 x 360; arm_and_twin, side_by_side, e3_e4 and map_stable take too long. Without pngquant or gnuplot no
stills are compared.
"""
import concurrent.futures
import html
import importlib.machinery
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import picture
import program
from program import ROOT, main
from waiting import TIMEOUT

SCRIPT = ROOT / "scripts/generate/pictures"
PICTURES = ROOT / "docs/pictures"
LARGE = {"arm_and_twin", "side_by_side", "e3_e4", "map_stable"}  # studio quality; recordings; the study; 4096 runs
BY_HAND = {"friction", "heaps", "lab", "map_throughput", "layers", "work_precision"}
# Of the squares. pngquant, which computes in floats, reduces the same picture to 256 colours that differ in up to
# 0.0035 of the squares between processors; without one overlay it is 0.02 or more.
MAX_VISIBLE = 0.005
MAX_BYTES = 3.5e6    # of all pictures and films of docs/


def stills():
    """The names of the script's pictures."""
    return set(re.findall(r"^ *(?:picture|fewer_colours) (\w+)", SCRIPT.read_text(), re.M))


class DocumentedPictures(unittest.TestCase):
    @unittest.skipUnless(shutil.which("pngquant") and shutil.which("gnuplot"),
                         "no pngquant or gnuplot: scripts/setup --docs")
    def test_stills_are_what_the_script_makes(self):
        names = sorted(stills() - LARGE)
        self.assertGreater(len(names), 13)
        with tempfile.TemporaryDirectory() as place:
            environment = dict(os.environ, TWINARM=program.PROGRAM)

            def make(some):
                done = subprocess.run([SCRIPT, "--out", place, *some], env=environment, capture_output=True, text=True,
                                      timeout=TIMEOUT)
                self.assertEqual(done.returncode, 0, done.stderr)

            with concurrent.futures.ThreadPoolExecutor(2) as pool:
                list(pool.map(make, (names[::2], names[1::2])))
            for name in names:
                made, committed = pathlib.Path(place) / f"{name}.png", PICTURES / f"{name}.png"
                if made.read_bytes() == committed.read_bytes():
                    continue
                with self.subTest(name, remedy=f"scripts/generate/pictures {name}"):
                    self.assertLess(picture.share_seen(picture.read_png(
                        committed), picture.read_png(made)), MAX_VISIBLE)

    def test_films_contain_the_recipe_of_today(self):
        printed = subprocess.run([SCRIPT, "--recipes"], check=True, capture_output=True, text=True).stdout
        recipes = dict(line.split() for line in printed.splitlines())
        self.assertEqual(sorted(recipes), sorted(film.stem for film in PICTURES.glob("*.mp4")))
        for name, recipe in recipes.items():
            with self.subTest(name, remedy=f"scripts/generate/pictures --films {name}"):
                self.assertTrue(f"recipe {recipe}".encode() in (PICTURES / f"{name}.mp4").read_bytes())

    def test_layers_are_drawn_as_cmake_has_them(self):
        listed = pathlib.Path(program.PROGRAM).parent / "layers.txt"
        if not listed.is_file():
            self.skipTest("the program does not lie in a build folder")
        sys.dont_write_bytecode = True
        loader = importlib.machinery.SourceFileLoader("layers", str(ROOT / "scripts/generate/layers"))
        layers = importlib.util.module_from_spec(importlib.util.spec_from_loader("layers", loader))
        loader.exec_module(layers)
        expected = {f"{one}->{other}" for one, other in layers.edges(layers.read_layers(listed.parent))}
        titles = map(html.unescape, re.findall(r"<title>(.*?)</title>", (PICTURES / "layers.svg").read_text()))
        self.assertEqual({title for title in titles if "->" in title}, expected, "run scripts/generate/layers")

    def test_every_picture_has_a_script_and_all_are_small(self):
        self.assertEqual({file.stem for file in PICTURES.glob("*.[ps][nv]g")}, stills() | BY_HAND)
        files = [file for file in (ROOT / "docs").rglob("*")
                 if file.suffix in (".png", ".svg", ".mp4", ".gif", ".webm")]
        self.assertLess(sum(file.stat().st_size for file in files), MAX_BYTES)
        self.assertEqual([file.name for file in files if file.suffix == ".gif"], [])


if __name__ == "__main__":
    main()
