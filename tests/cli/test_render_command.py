"""`twinarm render`: stills, films, rejected input."""
import os
import struct

import picture
from program import SCENES, ProgramTest, data, main

BALL = data("dropped_ball.toml")
# Replaces ffmpeg: writes its arguments and the number of input bytes; fails on demand.
FAKE = """#!/bin/sh
for word in "$@"; do last=$word; done
if [ -n "$FAIL" ]; then echo "no such codec" >&2; exit 3; fi
echo "$@" > "$last"
wc -c >> "$last"
"""


def png_size(data):
    assert data[:8] == b"\x89PNG\r\n\x1a\n" and data[-8:-4] == b"IEND", "no whole PNG"
    return struct.unpack(">II", data[16:24])


class Render(ProgramTest):
    def setUp(self):
        super().setUp()
        self.ball = self.write("ball.toml", BALL)

    def environment(self, path=None, **more):
        return dict(os.environ, **more, **({"PATH": str(path)} if path else {}))

    def rendered(self, *words, **more):
        return self.json_of("render", *words, env=self.environment(**more))

    def refusals(self, *words, **more):
        return self.faults("render", *words, env=self.environment(**more))

    def fake_ffmpeg(self):
        folder = self.folder / "bin"
        folder.mkdir(exist_ok=True)
        fake = folder / "ffmpeg"
        fake.write_text(FAKE)
        fake.chmod(0o755)
        return f"{folder}:{os.environ['PATH']}"

    def test_each_scene_gives_a_picture_with_all_overlays(self):
        scenes = sorted(SCENES.glob("*.toml"))
        self.assertGreater(len(scenes), 10)
        for scene in scenes:
            with self.subTest(scene=scene.stem):
                out = self.folder / f"{scene.stem}.png"
                reported = self.rendered(scene, "--png", out, "--size", "321x203",
                                         "--quality", "draft", "--show", "all")
                self.assertEqual(png_size(out.read_bytes()), (321, 203))
                self.assertEqual((reported["width"], reported["height"], reported["pictures"]), (321, 203, 1))

    def test_the_same_picture_twice_has_the_same_bytes_and_another_instant_has_others(self):
        pictures = []
        for name, at in (("a", 0.3), ("b", 0.3), ("c", 0.1)):
            out = self.folder / f"{name}.png"
            self.rendered(self.ball, "--png", out, "--at", at, "--size", "160x120",
                          "--camera", "0,10,3", "--show", "none")
            pictures.append(out.read_bytes())
        self.assertEqual(pictures[0], pictures[1])
        self.assertNotEqual(pictures[0], pictures[2])

    def test_the_field_of_view_and_the_wrenches_are_options_of_a_picture(self):
        robot = "assets/robots/puma560/puma560.urdf"
        pictures = set()
        run, out = self.record("a"), self.folder / "a.png"
        for words in (["--show", "none"], ["--show", "none", "--fov", 80], ["--show", "wrenches"]):
            for model in (run, robot):
                self.rendered(model, "--png", out, "--size", "160x120", *words)
                pictures.add(out.read_bytes())
        self.assertEqual(len(pictures), 6)
        self.assertEqual(self.refusals(robot, "--png", out, "--orbit", 20)[0]["where"], "--orbit")
        self.assertIn("is nan", self.refusals(robot, "--frames", self.folder / "f", "--orbit", "nan")[0]["problem"])

    def test_the_camera_of_a_film_turns_and_comes_back(self):
        scene = self.folder / "still.toml"
        scene.write_text('gravity = [0, 0, 0]\n[[body]]\nname = "box"\nmass = 1\n'
                         'shape = { box = { size = [1, 2, 3] } }\n')
        out = self.folder / "film"
        self.rendered(scene, "--frames", out, "--size", "160x120", "--quality", "draft", "--camera", "0,20",
                      "--to", 0.4, "--slow-motion", 10, "--fps", 1, "--orbit", 90, "--show", "none")
        # Below the title, which has the time.
        frames = [picture.read_png(file)[2][40:] for file in sorted(out.iterdir())]
        self.assertEqual(len(frames), 5)
        self.assertEqual(frames[0], frames[4])
        self.assertNotEqual(frames[0], frames[1])

    def test_a_film_has_the_given_rate_and_slow_motion_factor(self):
        out = self.folder / "film"
        reported = self.rendered(self.ball, "--frames", out, "--size", "64x48", "--quality", "draft",
                                 "--from", 0.1, "--to", 0.3, "--slow-motion", 2, "--fps", 10)
        self.assertEqual(reported["pictures"], 5)  # each 0.05 s, both ends
        self.assertAlmostEqual(reported["from"], 0.1, places=9)
        self.assertAlmostEqual(reported["to"], 0.3, places=9)
        self.assertEqual(sorted(p.name for p in out.iterdir()), [f"frame_{i:05}.png" for i in range(5)])

    def test_a_recording_gives_the_video_of_its_run(self):
        out = self.folder / "film"
        reported = self.rendered(self.record("run"), "--frames", out, "--size", "64x48", "--quality", "draft",
                                 "--fps", 10, "--show", "all")
        self.assertEqual((reported["pictures"], reported["from"]), (6, 0))
        self.assertAlmostEqual(reported["to"], 0.5, places=9)

    def record(self, name, **changes):
        scene, recording = self.folder / f"{name}.toml", self.folder / f"{name}.twinrec"
        scene.write_text(data("dropped_ball.toml", **changes))
        self.twinarm("simulate", scene, "--record", recording)
        return recording

    def test_two_recordings_are_shown_side_by_side_to_the_end_of_the_longer_one(self):
        left, right = self.record("a"), self.record("b", duration=0.3)
        out = self.folder / "film"
        reported = self.rendered(left, "--side-by-side", right, "--frames", out, "--size", "200x60", "--fps",
                                 10, "--show", "none", "--plot", "energy")
        self.assertEqual(reported["pictures"], 6)
        pictures = [picture.read_png(p) for p in sorted(out.iterdir())]
        left_of = [[bytes(row[:3 * 90]) for row in rows] for _, _, rows in pictures]
        right_of = [[bytes(row[3 * 110:]) for row in rows] for _, _, rows in pictures]
        self.assertEqual(len({tuple(map(bytes, rows)) for rows in left_of}), 6)
        self.assertEqual(len({tuple(map(bytes, rows)) for rows in right_of}), 4)  # then its last frame
        self.assertTrue(self.refusals(left, "--side-by-side", self.ball, "--frames", out))

    def test_a_plot_is_at_the_bottom_and_its_cursor_moves_with_time(self):
        recording = self.record("a")
        columns = []
        for at in (0.1, 0.2, 0.3):
            out = self.folder / "plot.png"
            self.rendered(recording, "--png", out, "--at", at, "--size", "640x360", "--quality",
                          "draft", "--plot", "energy")
            _, _, rows = picture.read_png(out)
            # The red cursor: the reddest column over some rows of the panel.
            columns.append(min(range(640), key=lambda x: sum(
                abs(row[3 * x] - 204) + abs(row[3 * x + 1] - 41) + abs(row[3 * x + 2] - 36)
                for row in rows[300:330])))
        self.assertAlmostEqual(columns[1] - columns[0], columns[2] - columns[1], delta=1.01)
        self.assertGreater(columns[1] - columns[0], 80)  # a fifth of the panel

    def test_ffmpeg_receives_all_pixels_and_the_film_is_renamed_at_the_end(self):
        path = self.fake_ffmpeg()
        for option, format_word in (("--mp4", "mp4"), ("--gif", "gif")):
            out = self.folder / f"film.{format_word}"
            reported = self.rendered(self.ball, option, out, "--size", "33x17", "--quality", "draft",
                                     "--to", 0.2, "--fps", 10, path=path)
            words, count = out.read_text().splitlines()
            self.assertEqual(int(count), reported["pictures"] * 33 * 17 * 4)
            self.assertIn("-s 33x17 -r 10", words)
            self.assertIn(f"-f {format_word} ", words)
        self.assertEqual(list(self.folder.glob("*.part")), [])

    def test_no_name_of_a_film_is_an_option_or_an_address_for_ffmpeg(self):
        for name in ("-y.mp4", "http:x.mp4"):
            self.json_of("render", self.ball, f"--mp4={name}", "--size", "32x16", "--quality", "draft", "--to", 0.1,
                         env=self.environment(self.fake_ffmpeg()), cwd=self.folder)
            words = (self.folder / name).read_text().split("\n")[0]
            self.assertTrue(words.endswith(f"{self.folder}/{name}.part"), words)

    def test_a_missing_or_failing_ffmpeg_is_reported_and_no_file_remains(self):
        out = self.folder / "film.mp4"
        (fault,) = self.refusals(self.ball, "--mp4", out, path=self.folder)
        self.assertEqual(fault["where"], "--mp4")
        self.assertIn("apt-get install ffmpeg", fault["fix"])
        self.refusals(self.ball, "--mp4", out, "--size", "64x48", path=self.fake_ffmpeg(), FAIL="1")
        self.assertEqual(list(self.folder.glob("film*")), [])

    def test_ctrl_c_leaves_no_partial_film(self):
        self.interrupted("render", self.ball, "--mp4", self.folder / "film.mp4", "--fps", 1000,
                         env=self.environment(self.fake_ffmpeg()),
                         is_ready=lambda _: (self.folder / "film.mp4.part").exists())
        self.assertEqual(list(self.folder.glob("film*")), [])

    def test_invalid_options_are_reported_as_typed_and_before_rendering(self):
        run, out, film = self.record("a"), self.folder / "b.png", self.folder / "film"
        for words in (["--to", "9"], ["--from", "7", "--to", "9"]):
            faults = self.refusals(run, "--frames", film, *words)
            self.assertEqual([(f["where"], f["problem"].split()[0]) for f in faults],
                             list(zip(words[::2], words[1::2])))
        for words in (["--png", out, "--at", "9"], ["--frames", film, "--to", "9"]):
            self.assertIn("neither", self.refusals(run, "--side-by-side", run, *words)[0]["problem"])
        self.assertIn("--gravity", self.refusals(run, "--png", out, "--gravity", "0,0,-1")[0]["where"])
        self.assertEqual(len(self.refusals(self.ball, "--frames", run, path=self.fake_ffmpeg())), 1)

    def test_a_link_with_a_missing_mesh_is_drawn_by_its_collision_shapes_with_a_warning(self):
        urdf = self.folder / "rod.urdf"
        urdf.write_text("""<robot name="rod"><link name="base"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><mesh filename="gone.stl"/></geometry></visual>
<collision><geometry><box size="1 1 1"/></geometry></collision></link></robot>""")
        out = self.folder / "rod.png"
        reported = self.rendered(urdf, "--png", out, "--size", "64x48")
        self.assertTrue(any("'base'" in w and "collision shapes" in w for w in reported["warnings"]))


if __name__ == "__main__":
    main()
