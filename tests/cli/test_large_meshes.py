"""Robots from meshes of a hundred thousand triangles."""
import itertools
import math
import signal
import struct

import program
from program import ProgramTest, main
from waiting import processor_time_of_ended

MAX_SECONDS = 20  # of CPU time, ten times what it takes; comparing each face with each vertex takes 45


def stl_ball(rings):
    """Binary STL of a sphere with 4 rings (rings - 1) triangles."""
    def point(i, j):
        polar, azimuth = math.pi * i / rings, math.pi * (j % (2 * rings)) / rings
        radius = math.sin(polar) if 0 < i < rings else 0
        return radius * math.cos(azimuth), radius * math.sin(azimuth), math.cos(polar)

    triangles = []
    for i, j in itertools.product(range(rings), range(2 * rings)):
        if i < rings - 1:
            triangles.append(((i, j), (i + 1, j), (i + 1, j + 1)))
        if i > 0:
            triangles.append(((i, j), (i + 1, j + 1), (i, j + 1)))
    return bytes(80) + struct.pack("<I", len(triangles)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *point(*a), *point(*b), *point(*c), 0) for a, b, c in triangles)


class LargeMeshes(ProgramTest):
    def recipe(self, links, rings):
        """Of a chain of balls of steel."""
        (self.folder / "meshes").mkdir()
        (self.folder / "meshes/ball.stl").write_bytes(stl_ball(rings))
        text = 'name = "balls"\nmesh_scale = 0.1\n[material.steel]\ndensity = 7800\ncolor = [1, 1, 1, 1]\n'
        for k in range(links):
            text += f'[[link]]\nname = "l{k}"\n[[link.part]]\nmesh = "ball"\nmaterial = "steel"\n'
            text += f'[[link.collision]]\nparts = ["ball"]\nname = "hull{k}"\n'
        for k in range(1, links):
            text += (f'[[joint]]\nname = "j{k}"\ntype = "revolute"\nparent = "l{k - 1}"\nchild = "l{k}"\n'
                     "axis = [0, 1, 0]\norigin = [0, 0, 0.3]\nlimits = [-1, 1]\n")
        return self.write("balls.toml", text)

    def test_a_robot_of_six_links_of_a_hundred_thousand_triangles_is_made_simulated_and_interrupted(self):
        recipe = self.recipe(6, 160)
        before = processor_time_of_ended()
        self.twinarm("make-robot", recipe)
        hull = (self.folder / "collision/hull0.stl").stat().st_size
        self.assertGreater((hull - 84) / 50, 100000)  # triangles: no vertex is inside the hull of a ball
        scene = self.write("scene.toml", '[[robot]]\nname = "r"\nmodel = "balls.urdf"\n[[body]]\nname = "box"\n'
                           "fixed = true\nshape = { box = { size = [1, 1, 1] } }\nposition = [0, 0, -2]\n")
        self.twinarm("simulate", scene, "--duration", 0.001)
        if "san" not in program.PROGRAM:
            self.assertLess(processor_time_of_ended() - before, MAX_SECONDS)

        # SIGTERM while a run that has opened its recording reads the meshes.
        recording, part = self.folder / "run.twinrec", self.folder / "run.twinrec.part"
        recording.write_bytes(b"of before")
        _, reported = self.interrupted("simulate", scene, "--duration", 1, "--record", recording,
                                       is_ready=lambda _: part.exists(),
                                       blow=signal.SIGTERM)
        self.assertEqual(reported, "twinarm: interrupted; no partial files were left\n")
        self.assertEqual(recording.read_bytes(), b"of before")
        self.assertFalse(part.exists())

    def test_sigterm_ends_making_a_robot_between_two_links_without_any_file(self):
        recipe = self.recipe(100, 24)
        _, reported = self.interrupted("make-robot", recipe, blow=signal.SIGTERM)
        self.assertIn("no partial files", reported)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["balls.toml", "meshes"])


if __name__ == "__main__":
    main()
