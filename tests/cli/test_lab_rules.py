"""`twinarm lab`: time, changes, history and files."""
import json
import os
import shutil
import struct
import time

from lab_test import LabTest, Running
from live_socket import Frame, Lab
from program import SCENES, ProgramTest, main

K, B = "coupling[0].stiffness", "coupling[0].damping"


class LabRules(LabTest):
    def test_a_new_client_gets_paused_and_earlier_frames(self):
        self.frame(lambda f: f.time > 0.5)
        stood = self.stand()
        self.live.do("seek", at=0.25)
        looked = self.frame(lambda f: f.looked_back)
        self.assertLess(looked.time, stood.time)
        with self.lab.live() as other:
            for _ in other.messages():
                if {"scene", "state", "frame"} <= other.newest.keys():
                    break
            self.assertEqual(json.loads(other.newest["state"])["at"], 0.25)
            frame, scene = Frame(other.newest["frame"]), json.loads(other.newest["scene"])
            self.assertEqual((frame.step, frame.scene), (looked.step, scene["scene"]))

    def test_seeking_pauses_and_playing_returns_to_the_present(self):
        self.frame(lambda f: f.time > 0.5)
        self.live.do("seek", at=0.1)
        self.assertFalse(self.state(lambda s: s["at"] is not None)["playing"])
        self.live.do("play", on=True)
        self.assertTrue(self.state(lambda s: s["at"] is None)["playing"])
        self.frame(lambda f: not f.looked_back and f.time > 0.8)

    def test_a_diverged_run_neither_plays_nor_steps(self):
        self.live.do("set", changes=[f"{K}=1e8"])
        time_of_death = self.state(lambda s: s["failure"])["failure"]["time"]
        self.live.do("play", on=True)
        self.live.do("step", steps=500)
        self.live.do("speed", factor=2)
        state = self.state(lambda s: s["speed"] == 2)
        self.assertFalse(state["playing"])
        self.assertTrue(state["failure"])
        self.assertAlmostEqual(state["time"], time_of_death, delta=0.002)
        self.live.do("speed", factor=0.001)  # it runs three steps again; slow enough for a state message
        self.live.do("reset")
        state = self.state(lambda s: not s["failure"])
        self.assertTrue(state["playing"])
        self.assertEqual(state["first"], 0)

    def test_the_last_accepted_change_of_a_path_is_in_effect(self):
        for changes in ([f"{K}=21"], [f"{K}=22"], [f"{B}=-1"], [f"{B}=3"]):
            self.live.do("set", changes=changes)
            if changes == [f"{B}=-1"]:
                self.state(lambda s: any(n["level"] == "error" for n in s["notes"]))
            else:
                self.state(lambda s: changes[0] in s["changes"])
        self.state(lambda s: s["changes"] == [f"{K}=22", f"{B}=3"])
        self.assertIn("22", self.lab.get("/scene").body.decode())

    def test_the_energy_balance_continues_over_a_change(self):
        gravity = self.live.wait_for("scene", lambda s: "gravity" in s["energy_balance"])[
            "energy_balance"].index("gravity")
        self.frame(lambda f: f.time > 0.4)
        before = self.stand()
        self.live.do("set", changes=[f"{B}=21"])
        self.state(lambda s: s["changes"])
        self.live.do("step", steps=1)
        after = self.frame(lambda f: f.step == before.step + 1)
        self.assertGreater(abs(before.works[gravity]), 0.1)
        self.assertAlmostEqual(after.works[gravity], before.works[gravity], delta=0.1)

    def test_a_branch_shows_the_run_that_was_left_and_new_input_takes_precedence(self):
        scene = self.live.wait_for("scene")
        layer = [one["name"] for one in scene["layers"]].index("earlier-run")
        self.live.do("layers", names=["bodies", "earlier-run"])
        self.live.do("joint", index=0, value=-0.4, stamp=1.0)
        self.frame(lambda f: f.time > 2)
        self.live.do("branch", at=0.5, changes=[f"{K}=200"])
        branch = self.frame(lambda f: f.time < 1 and f.first[layer + 1] > f.first[layer])
        self.assertLess(branch.time, 1)
        q = [c["name"] for c in scene["channels"]].index("q/hinge")
        self.live.do("joint", index=0, value=0.9, stamp=2.0)
        self.frame(lambda f: f.stamp == 2.0 and f.time < 2)
        self.frame(lambda f: abs(f.channels[q] - 0.9) < 0.3)

    def test_the_last_twenty_notes_are_kept_in_order(self):
        for n in range(30):
            self.live.do(f"nothing{n}")
            self.state(lambda s: s["notes"] and f"nothing{n}" in s["notes"][-1]["text"])
        notes = self.state(lambda s: len(s["notes"]) == 20)["notes"]
        self.assertEqual([note["n"] for note in notes], list(range(notes[0]["n"], notes[0]["n"] + 20)))

    def test_another_scene_has_its_own_rows_and_history(self):
        self.frame(lambda f: f.time > 0.3)
        ball = '[[body]]\nname = "b"\nshape = { sphere = { radius = 0.1 } }\nmass = 1\n'
        number = self.live.wait_for("scene")["scene"]
        self.live.do("play", on=True)
        self.lab.upload("ball.toml", ball, self.live)
        scene = self.live.wait_for("scene", lambda s: s["scene"] > number)
        self.assertFalse([row for row in scene["energy_balance"]
                         if "pull" in row or "hinge" in row], scene["energy_balance"])
        self.assertLess(self.frame(lambda f: f.scene == scene["scene"]).time, 0.3)
        self.assertEqual(self.lab.history(0).scene, scene["scene"])

    def test_three_clients_get_thirty_frames_per_second_each(self):
        with self.lab.live() as second, self.lab.live() as third:
            for live in (second, third):
                live.wait_for("frame")
            self.state(lambda s: s["clients"] == 3)
            start = time.monotonic()
            frames = sum(kind == "frame" for kind, _ in self.live.messages(2.0))
            self.assertLess(frames, 31.5 * (time.monotonic() - start) + 4)

    def test_history_begins_at_the_requested_time(self):
        self.frame(lambda f: f.time > 1)
        self.stand()
        all_of_it, late = self.lab.history(), self.lab.history(0.7)
        self.assertEqual(all_of_it.time[0], 0)
        self.assertAlmostEqual(late.time[0], 0.7, delta=0.02)
        self.assertEqual(list(all_of_it.time[-late.frames:]), list(late.time))

    def test_invalid_requests_are_refused_or_limited(self):
        self.assertEqual(self.lab.post("/save", "x").status, 403)
        self.assertEqual(self.lab.upload("part.stl", "solid", self.live).status, 202)
        for name in ("/etc/x.toml", "%2ftmp/x.toml", "..%2fx.toml", "a/../../x.toml", ".hidden.toml", "a" * 300):
            self.assertEqual(self.lab.upload(name, "step = 1", self.live).status, 422, name)
        for query, size in (("width=1e9&height=1", (1920, 64)), ("width=nan&height=-5", (960, 64)),
                            ("width=200&height=100", (200, 100))):
            picture = self.lab.get(f"/frame.png?{query}").body
            self.assertEqual(struct.unpack(">II", picture[16:24]), size)

    def test_a_preset_opens_its_scene_with_its_values(self):
        self.live.do("input", source="joints")
        for name, source in (("E1", "drag"), ("E3", "scene")):
            self.live.do("preset", name=name)
            state = self.state(lambda s: s["name"] == name)
            self.assertEqual(state["input"]["source"], source)
        self.live.do("preset", name="E9")
        self.state(lambda s: "E9" in self.reported(s))


class LabTemporaryFiles(ProgramTest):
    def start(self, scene):
        self.running = Running(SCENES / scene, env=dict(os.environ, TMPDIR=str(self.folder)))
        self.addCleanup(self.running.process.kill)
        self.lab = Lab(self.running.url)
        self.live = self.lab.live()
        self.addCleanup(self.live.close)

    def test_uploaded_files_are_removed_at_the_end(self):
        self.start("cradle.toml")
        self.assertEqual(self.lab.upload("part.stl", "solid", self.live).status, 202)
        self.assertEqual(len(list(self.folder.rglob("part.stl"))), 1)
        self.live.close()
        self.assertEqual(self.running.end(), (0, ""))
        self.assertEqual(list(self.folder.iterdir()), [])

    def remove_copies(self):
        for copies in self.folder.glob("twinarm-replay-*"):
            shutil.rmtree(copies)
            yield copies

    def test_removed_copies_are_written_again(self):
        self.start("bouncing_ball.toml")
        self.live.wait_for("frame")
        self.assertEqual(len(list(self.remove_copies())), 1)
        self.live.do("inspect", on=True, body=1)
        self.live.wait_for("inspection")
        list(self.remove_copies())
        self.live.do("set", changes=["gravity=0,0,-1.62"])
        self.live.wait_for("state", lambda s: s["changes"] == ["gravity=0,0,-1.62"])
        self.assertEqual(self.running.end(), (0, ""))

    def test_copies_that_cannot_be_written_again_are_reported_and_the_lab_goes_on(self):
        self.start("bouncing_ball.toml")
        self.live.wait_for("frame")
        places = list(self.remove_copies())
        for place in places:
            place.write_text("not a folder")
        self.live.do("inspect", on=True, body=1)
        notes = self.live.wait_for("state", lambda s: s["notes"])["notes"]
        self.assertEqual(notes[-1]["level"], "error")
        self.assertIn("the lab cannot draw this", notes[-1]["text"])
        step = self.live.wait_for("frame").step
        self.live.wait_for("frame", lambda f: f.step > step)
        for place in places:
            place.unlink()
        self.live.wait_for("inspection")
        self.assertEqual(self.running.end(), (0, ""))


if __name__ == "__main__":
    main()
