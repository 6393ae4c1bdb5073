"""Pictures of `twinarm render` against reviewed ones (golden/).

    test_pictures.py PATH/TO/twinarm           compares
    test_pictures.py PATH/TO/twinarm --make    replaces them: review each before it is committed

Versions of Mesa and FreeType may differ in some pixels. Pictures differ visibly in squares of 6 x 6 pixels
whose mean differs by more than a just noticeable difference.
"""
import os
import pathlib
import sys
import tempfile
import unittest

import picture  # noqa: E402

import program
from program import ROOT, SCENES, run

HERE = pathlib.Path(__file__).resolve().parent
MAX_VISIBLE = 0.002  # of the squares: 7 of the 3600
SIZE = "480x270"
GOLDEN = {
    "arm_and_target": [SCENES / "robot_beside_obstacles.toml", "--at", "1", "--camera", "128,25",
                       "--show", "targets,couplings,contacts,forces,energy"],
    "boxes": [SCENES / "box_stack.toml", "--at", "0.3", "--show", "contacts,forces,com,gravity"],
    "bars": [SCENES / "four_bar.toml", "--at", "0.4", "--show", "trails,labels,frames,momentum"],
    "sky": [SCENES / "turntable.toml", "--at", "0.5", "--camera", "30,8", "--background", "sky"],
    "puma": [ROOT / "assets/robots/puma560/puma560.urdf", "--show", "joints,inertia"],
}


def paint(folder, name, words, **environment):
    out = pathlib.Path(folder) / f"{name}.png"
    run("render", *words, "--png", out, "--size", SIZE, check=True, env=dict(os.environ, **environment))
    return out


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.painted = {name: paint(cls.holder.name, name, words) for name, words in GOLDEN.items()}

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def share(self, name, path):
        return picture.share_seen(picture.read_png(HERE / "golden" / f"{name}.png"), picture.read_png(path))

    def test_each_picture_equals_its_golden_picture_visibly(self):
        for name, path in self.painted.items():
            with self.subTest(picture=name):
                self.assertLess(self.share(name, path), MAX_VISIBLE)

    def test_a_missing_overlay_another_instant_and_another_view_are_detected(self):
        words = GOLDEN["boxes"]
        for what, other in (("no weights", [*words[:-1], "contacts,forces,com"]),
                            ("no cones", [*words[:-1], "forces,com,gravity"]),
                            ("a degree", [*words, "--camera", "-51,22"])):
            with self.subTest(what=what):
                self.assertGreater(self.share("boxes", paint(self.holder.name, "other", other)), 2 * MAX_VISIBLE)
        for background in ("studio", "white"):
            with self.subTest(what=background):
                other = [*GOLDEN["sky"][:-1], background]
                self.assertGreater(self.share("sky", paint(self.holder.name, "other", other)), 0.3)
        words = GOLDEN["bars"]
        later = [*words[:1], "--at", "0.41", *words[3:]]
        self.assertGreater(self.share("bars", paint(self.holder.name, "other", later)), 2 * MAX_VISIBLE)

    def test_both_back_ends_and_any_number_of_threads_give_the_same_bytes(self):
        for gl in ("osmesa", "egl"):
            for threads in ("0", "1", "2", "5"):
                with self.subTest(gl=gl, threads=threads):
                    other = paint(self.holder.name, "other", [*GOLDEN["boxes"], "--gl", gl], LP_NUM_THREADS=threads)
                    self.assertEqual(other.read_bytes(), self.painted["boxes"].read_bytes())
        for quality, name in (("draft", "bars"), ("studio", "bars"), ("draft", "arm_and_target"), ("normal", "sky")):
            a, b = (paint(self.holder.name, gl, [*GOLDEN[name], "--gl", gl, "--quality", quality],
                          LP_NUM_THREADS=threads) for gl, threads in (("osmesa", "0"), ("egl", "3")))
            with self.subTest(quality=quality, picture=name):
                self.assertEqual(a.read_bytes(), b.read_bytes())


if __name__ == "__main__":
    if "--make" in sys.argv:
        program.PROGRAM = os.path.abspath(sys.argv[1])
        for golden, words in GOLDEN.items():
            print(paint(HERE / "golden", golden, words))
    else:
        program.main()
