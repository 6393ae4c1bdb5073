"""`twinarm lab`: the whole program over its socket, with one and several clients."""
import json
import math
import os
import pathlib
import re
import signal
import time

import program
from lab_test import ROD, SCENE, LabTest, Running
from live_socket import Lab
from program import SCENES, ProgramTest, main
from waiting import TIMEOUT, wait_for


class LabCommand(LabTest):
    def test_a_new_client_gets_scene_state_and_frame(self):
        scene = self.live.wait_for("scene")
        self.assertEqual([layer["name"] for layer in scene["layers"]][0], "bodies")
        self.assertEqual([body["name"] for body in scene["bodies"]], ["world", "base", "rod", "ball"])
        state = self.state()
        self.assertTrue(state["playing"])
        self.assertEqual(state["controller"], state["you"])
        self.assertIn("coupling[0].stiffness", json.dumps(state["parameters"]))
        frame = self.frame()
        self.assertEqual(frame.scene, scene["scene"])
        self.assertEqual(len(frame.channels), len(scene["channels"]))
        for mesh in scene["meshes"]:
            self.assertEqual(self.lab.get(f"/mesh/{mesh}").status, 200)

    def test_frames_equal_the_recording_which_replays_bit_for_bit(self):
        names = [c["name"] for c in self.live.wait_for("scene")["channels"]]
        seen = {}
        while len(seen) < 90:
            frame = self.live.wait_for("frame")
            seen[frame.step] = dict(zip(names, frame.channels))
        file = self.saved("run.twinrec")
        self.assertIn("same bits", self.twinarm("replay", file).stdout)
        recorded = self.by_step(file)
        both = sorted(set(seen) & set(recorded))
        self.assertGreater(len(both), 60)
        for step in both:
            for name in ("q/hinge", "qd/hinge", "links/rod/x", "kinetic_energy"):
                self.assertEqual(seen[step][name], recorded[step]["values"][name], name)

    def test_while_paused_single_steps_are_taken(self):
        before = self.stand()
        self.live.do("step", steps=7)
        after = self.frame(lambda f: f.step == before.step + 7)
        self.assertAlmostEqual(after.time - before.time, 0.007, places=12)
        self.live.do("seek", at=before.time / 2)
        old = self.frame(lambda f: f.looked_back)
        self.assertLessEqual(old.time, before.time / 2)
        self.live.do("seek", at=None)
        self.assertEqual(self.frame(lambda f: not f.looked_back).step, after.step)

    def test_a_branch_repeats_the_run_without_a_change_and_differs_with_one(self):
        self.frame(lambda f: f.time > 1.5)
        self.live.do("play", on=False)
        self.state(lambda s: not s["playing"])
        first = self.by_step(self.saved("first.twinrec"))
        compared = {}
        for changes, is_same in ((["coupling[0].stiffness=2000"], True), (["coupling[0].stiffness=3500"], False)):
            self.live.do("branch", at=0.5, changes=changes)
            state = self.state(lambda s: s["branch"] and s["branch"]["changes"] == changes)
            self.assertAlmostEqual(state["branch"]["from"], 0.5, delta=0.02)
            self.frame(lambda f: f.time > 1.4)
            self.live.do("play", on=False)
            self.state(lambda s: not s["playing"])
            branch = self.by_step(self.saved("branch.twinrec"))
            both = [step for step in set(first) & set(branch) if first[step]["t"] > 0.6]
            compared[is_same] = [first[s]["values"] == branch[s]["values"] for s in both]
        self.assertTrue(compared[True])
        self.assertTrue(all(compared[True]))
        self.assertFalse(any(compared[False]))

    def test_a_diverged_run_stops_with_a_reason_and_its_fix_is_stable(self):
        self.frame(lambda f: f.time > 0.5)
        self.live.do("set", changes=["coupling[0].stiffness=1e8"])
        failure = self.state(lambda s: s["failure"])["failure"]
        self.newest_frame(lambda f: f.diverged)
        if failure["trying"]:
            failure = self.state(lambda s: not s["failure"]["trying"])["failure"]
        self.assertIn("pull", " ".join(failure["words"]))
        self.assertTrue(failure["remedies"])
        self.assertLess(failure["from"], failure["time"])
        for remedy in failure["remedies"]:
            self.live.do("branch", at=failure["from"], changes=remedy["changes"])
            self.state(lambda s: s["branch"] and not s["failure"])
            self.frame(lambda f: f.time > 1.5)
            self.assertIsNone(self.state()["failure"], remedy["words"])

    def test_operator_input_drives_the_robot_and_the_mouse_spring_drags_the_ball(self):
        scene = self.live.wait_for("scene")
        names = [c["name"] for c in scene["channels"]]
        ball = [b["name"] for b in scene["bodies"]].index("ball")
        self.live.do("joint", index=0, value=-0.4, stamp=42.0)
        frame = self.frame(lambda f: f.stamp == 42.0)
        self.assertLess(frame.input_age, 0.2)
        at = names.index("q/hinge")
        self.frame(lambda f: abs(f.channels[at] + 0.4) < 0.2)
        self.live.do("drag_body", body=ball, point=[0, 0, 0], goal=[2, 1, 1], stamp=43.0)
        y = names.index("links/ball/y")
        self.frame(lambda f: f.channels[y] > 0.8)
        self.live.do("release")

    def test_inputs_cause_no_extra_frames(self):
        self.frame()
        start, seen = time.monotonic(), []
        for n in range(300):
            self.live.do("joint", index=0, value=0.3 * (n % 2), stamp=1.0 + n)
            seen += [frame for kind, frame in self.live.messages(0.005) if kind == "frame"]
        self.assertLess(len(seen), 63 * (time.monotonic() - start) + 3)
        self.assertEqual(len({frame.step for frame in seen}), len(seen))

    def test_a_disconnected_client_releases_its_inputs(self):
        scene = self.live.wait_for("scene")
        names = [c["name"] for c in scene["channels"]]
        ball = [b["name"] for b in scene["bodies"]].index("ball")
        z = names.index("links/ball/z")
        with self.lab.live() as other:
            self.live.do("drag_body", body=ball, point=[0, 0, 0], goal=[2, 0, 4], stamp=1.0)
            other.wait_for("frame", lambda f: f.time > 2)  # held: it would lie at -1.9 by now
            self.assertGreater(other.wait_for("frame").channels[z], 2)
            self.live.close()
            other.wait_for("frame", lambda f: f.channels[z] < 0)
            other.do("button", index=0, down=True, stamp=2.0)
            other.do("input", source="joints")
            self.state(lambda s: s["input"]["gripper"], live=other)
        self.live = self.lab.live()  # and it finds the gripper as it was
        self.assertTrue(self.state()["input"]["gripper"])
        self.assertEqual(self.state()["input"]["source"], "joints")

    def test_control_is_granted_on_request(self):
        you = self.state()["you"]
        with self.lab.live() as other:
            second = self.state(live=other)
            self.assertEqual(second["controller"], you)
            other.do("set", changes=["coupling[0].stiffness=21"])
            self.assertIn("control", self.reported(self.state(lambda s: s["notes"], live=other)))
            other.do("request_control")
            self.state(lambda s: s["control_requests"] == [second["you"]])
            self.live.do("grant_control", to=second["you"])
            self.state(lambda s: s["controller"] == second["you"], live=other)
            other.do("set", changes=["coupling[0].stiffness=21"])
            self.state(lambda s: s["changes"] == ["coupling[0].stiffness=21"], live=other)
        self.state(lambda s: s["controller"] == you)  # the remaining client

    def test_invalid_commands_and_scenes_are_refused_and_the_run_continues(self):
        for text in ("", "{", "[1, 2]", '{"do": "fly"}', '{"do": "drag_stylus", "goal": ["a"]}',
                     '{"do": "set", "changes": ["coupling[0].colour=red"]}',
                     '{"do": "set", "changes": ["coupling[0].stiffness=-5"]}',
                     '{"do": "set", "changes": ["step=0"]}', '{"do": "scene", "name": "nowhere"}',
                     '{"do": "input", "source": "device", "spec": "ouija"}'):
            known = len(self.reported(self.state())) if text else 0
            self.live.say(text)
            self.state(lambda s: len(self.reported(s)) > known)
        bad = self.lab.upload("bad.toml", "[[robot]]\nmodel = 'no.urdf'\nmass = 3\n", self.live)
        self.assertEqual(bad.status, 422)
        self.assertIn("no.urdf", bad.body.decode())
        for name in ("../../etc/x.toml", "", "a%2f..%2fb.toml"):
            self.assertEqual(self.lab.upload(name, "x", self.live).status, 422)
        step = self.frame().step
        self.frame(lambda f: f.step > step)

    def test_a_robot_is_uploaded(self):
        number = self.live.wait_for("scene")["scene"]
        self.assertEqual(self.lab.upload("fresh.urdf", ROD, self.live).status, 200)
        scene = self.live.wait_for("scene", lambda s: s["scene"] > number)
        self.assertEqual(scene["file"], "fresh.urdf")
        self.frame(lambda f: f.scene == scene["scene"])

    def test_only_the_client_in_control_uploads_files(self):
        with self.lab.live() as other:
            refused = self.lab.upload("fresh.urdf", ROD, other)
            self.assertEqual((refused.status, refused.body),
                             (403, b"twinarm lab: another client has control; request it\n"))
            self.assertEqual(self.lab.post("/open?name=fresh.urdf", ROD).status, 403)
            self.assertEqual(self.lab.post("/open?name=fresh.urdf&secret=", ROD).status, 403)
            self.live.do("grant_control", to=self.state(live=other)["you"])
            self.state(lambda s: s["controller"] == s["you"], live=other)
            self.assertEqual(self.lab.upload("fresh.urdf", ROD, self.live).status, 403)
            self.assertEqual(self.lab.upload("fresh.urdf", ROD, other).status, 200)

    def test_the_saved_scene_and_the_shared_page_are_self_contained(self):
        self.live.do("set", changes=["coupling[0].stiffness=33"])
        self.state(lambda s: s["changes"])
        text = self.lab.get("/scene").body.decode()
        self.assertIn("33", text)
        self.twinarm("simulate", self.write("again.toml", text))
        self.frame(lambda f: f.time > 1)
        page = self.lab.get("/share")
        self.assertEqual(page.status, 200)
        self.assertIn(b"<html", page.body[:200])
        picture = self.lab.get("/frame.png?width=320&height=200")
        self.assertEqual(picture.body[:4], b"\x89PNG")

    def test_a_client_that_never_reads_does_not_delay_others(self):
        """Compared with itself on the same machine; scripts/measure/lab_load measures how fast it is."""
        def frames_and_time():
            times = [frame.time for kind, frame in self.live.messages(2.0) if kind == "frame"]
            return len(times), times[-1] - times[0]
        self.frame()
        without = frames_and_time()
        with self.lab.stalled():
            for found, wanted in zip(frames_and_time(), without):
                self.assertGreater(found, 0.5 * wanted)


class LabLanes(ProgramTest):
    """Variants."""

    def start(self, scene, *words):
        running = Running(scene, *words)
        self.addCleanup(lambda: self.assertEqual(running.end(), (0, "")))
        self.lab = Lab(running.url)
        self.live = self.lab.live()
        self.addCleanup(self.live.close)
        self.names = [c["name"] for c in self.live.wait_for("scene")["channels"]]

    def state(self, condition=lambda state: True):
        return self.live.wait_for("state", condition)

    def stand_at(self, steps):
        self.live.do("play", on=False)
        taken = self.live.wait_for("frame", lambda f: f.paused).step
        self.live.do("step", steps=steps - taken)
        return self.live.wait_for("frame", lambda f: f.step == steps, timeout=TIMEOUT)

    def test_six_integrators_differ_as_the_gallery_says(self):
        self.start("six_integrators")
        variants = self.state(lambda s: s["variants"])["variants"]
        self.stand_at(700)
        history = self.lab.history()
        self.assertAlmostEqual(history.time[-1], 14, delta=1e-9)

        def of(lane, quantity):
            return history.channel(self.names.index(f"variant/{quantity}/{lane}"))
        gain = {lane: [e - of(lane, "total_energy")[0] for e in of(lane, "total_energy")]
                for lane in variants["values"]}
        for lane, energies in gain.items():  # as in the energy balance
            for made, reported in zip(energies, of(lane, "numerical")):
                self.assertAlmostEqual(made, reported, delta=1e-9)
        late = [i for i, t in enumerate(history.time) if t > 10]
        self.assertGreater(min(gain["euler"][i] for i in late), 4.905)  # to the height of the hinge
        self.assertGreater(max(of("euler", "q/hinge")), math.pi)
        self.assertLess(max(gain["implicit-euler"][i] for i in late), -4.905 / 2)
        # First order in the step: h/2 times the power of gravity, g sin q qd.
        start = math.radians(60)
        most = max(0.01 * 9.81 * math.sin(q) * math.sqrt(2 * 9.81 * (math.cos(q) - 0.5))
                   for q in (start * i / 1000 for i in range(1000)))
        for found in (max(gain["semi-implicit"]), -min(gain["semi-implicit"])):
            self.assertAlmostEqual(found, most, delta=0.05 * most)
        for lane, most in (("verlet", 0.005), ("implicit-midpoint", 0.001), ("rk4", 0.0001)):
            self.assertLess(max(map(abs, gain[lane])), most)
            self.assertAlmostEqual(max(of(lane, "q/hinge")[i] for i in late), start, delta=0.01)

    def test_a_diverged_variant_is_reported_and_returns_with_a_branch(self):
        self.write("rod.urdf", ROD)
        self.start(self.write("rod.toml", SCENE), "--variants", "coupling[0].stiffness=200,1e8,3000")
        self.assertNotIn("coupling[0].stiffness", [k["path"] for k in self.state()["parameters"]])
        stopped = self.state(lambda s: s["variants"]["stopped"][1])["variants"]["stopped"]
        self.assertIsNone(stopped[2])
        frame = self.live.wait_for("frame", lambda f: f.time > stopped[1] + 0.3)
        self.assertFalse(frame.diverged)
        self.assertTrue([t for t in frame.label_texts() if t.startswith("1e8: stopped at")])
        state = self.state()
        self.assertTrue(state["playing"])
        self.assertIn("1e8 stopped at", " ".join(n["text"] for n in state["notes"]))
        self.live.do("set", changes=["coupling[0].stiffness=7"])
        self.state(lambda s: "varied between the variants" in " ".join(n["text"] for n in s["notes"]))
        # Stable with damping, from a time before it diverged.
        self.live.do("seek", at=0.0)
        self.state(lambda s: s["at"] == 0 and s["variants"]["stopped"] == [None] * 3)
        self.live.do("branch", at=0.0, changes=["coupling[0].discretization=implicit"])
        self.state(lambda s: s["branch"] and s["time"] > 0.5)
        self.assertEqual(self.state()["variants"]["stopped"], [None] * 3)
        self.live.do("reset")
        state = self.state(lambda s: not s["branch"])
        self.assertEqual(state["variants"]["values"], ["200", "1e8", "3000"])
        self.live.do("scene", name="gyroscope")
        self.state(lambda s: s["name"] == "gyroscope" and s["variants"] is None)

    def test_the_first_variant_is_saved(self):
        self.start("pendulum", "--variants", "integrator=rk4,euler")
        last = self.stand_at(100)
        file = self.folder / "first.twinrec"
        file.write_bytes(self.lab.get("/save").body)
        reported = self.json_of("export", file)
        values = dict(zip([c["name"] for c in reported["columns"]], reported["frames"][-1]["values"]))
        self.assertEqual(values["q/hinge"], last.channels[self.names.index("variant/q/hinge/rk4")])
        self.assertNotEqual(values["q/hinge"], last.channels[self.names.index("variant/q/hinge/euler")])
        self.assertIn('integrator = "rk4"', self.lab.get("/scene").body.decode())


class LabEnds(ProgramTest):
    def test_it_exits_with_0_and_leaves_no_files(self):
        for how in (signal.SIGINT, signal.SIGTERM):
            running = Running(SCENES / "cradle.toml", env=dict(os.environ, TMPDIR=str(self.folder)))
            with Lab(running.url).live() as live:
                live.wait_for("frame")
            self.assertEqual(running.end(how), (0, ""))
            self.assertEqual(list(self.folder.iterdir()), [])

    def test_files_are_read_by_children_of_a_process_without_threads_that_ends_with_the_lab(self):
        running = Running(SCENES / "bouncing_ball.toml")
        self.addCleanup(running.process.kill)
        tasks = pathlib.Path("/proc") / str(running.process.pid) / "task"
        self.assertGreater(len(list(tasks.iterdir())), 2)
        server, = (tasks / str(running.process.pid) / "children").read_text().split()
        server = pathlib.Path("/proc") / server
        own = 2 if "tsan" in program.PROGRAM else 1  # the sanitizer has a thread in each process
        self.assertEqual(len(list((server / "task").iterdir())), own)
        with Lab(running.url).live() as live:
            self.assertEqual(Lab(running.url).upload("rod.urdf", ROD, live).status, 200)
        running.process.kill()
        running.process.communicate()
        wait_for(lambda: not server.exists(), "the fork server has ended")

    def test_remote_clients_open_no_files_and_devices(self):
        for listen, is_refused in (("0.0.0.0", True), ("127.0.0.1", False)):
            running = Running(SCENES / "hand_and_obstacles.toml", "--listen", listen)
            self.addCleanup(running.process.kill)
            with Lab(running.url).live() as live:
                for spec in ("virtual:trace:/etc/passwd", "gamepad:/dev/nowhere"):
                    known = len(live.wait_for("state")["notes"])
                    live.do("input", source="device", spec=spec)
                    notes = live.wait_for("state", lambda s: len(s["notes"]) > known)["notes"]
                    self.assertEqual("with --listen this is not allowed" in notes[-1]["text"], is_refused, notes[-1])
                live.do("input", source="device", spec="virtual:synthetic")
                live.wait_for("state", lambda s: s["input"]["spec"] == "virtual:synthetic")
            running.end()

    def test_uploads_of_remote_clients_name_only_uploads_and_assets(self):
        secret = "the secret of this machine\n"
        body = ('[[body]]\nname = "ball"\nmass = 1\nshape = {{ sphere = {{ radius = 0.1 }} }}\n'
                'position = [0, 0, 1]\n{}')
        path = self.folder
        self.write("secret.png", secret)
        self.write("rod.urdf", ROD)
        running = Running(SCENES / "bouncing_ball.toml", "--listen", "0.0.0.0")
        self.addCleanup(running.process.kill)
        lab = Lab(running.url)
        with lab.live() as live:
            for name, text in (
                    ("a.toml", body.format(f'texture = "{path}/secret.png"')),
                    ("b.toml", body.format(f'texture = "../../..{path}/secret.png"')),
                    ("c.toml", f'[[robot]]\nname = "rod"\nmodel = "{path}/rod.urdf"'),
                    ("d.toml", SCENE.replace("rod.urdf", "robots/s103/s103.urdf").replace(
                        '"device"', f'"{path}/secret.png"')),
                    ("e.toml", body.format('texture = "/nowhere/secret.png"'))):
                reply = lab.upload(name, text, live)
                self.assertEqual(reply.status, 422, name)
                self.assertIn("this scene may not read the file", reply.body.decode(), name)
                self.assertNotIn("of this machine", reply.body.decode())
            mesh = f'<mesh filename="{path}/secret.png"/>'
            self.assertEqual(lab.upload("f.urdf", re.sub('<box.*?/>', mesh, ROD), live).status, 200)
            self.assertFalse(secret.encode() in lab.get("/save").body)
            # Permitted: uploads and assets.
            for name, text in (("rod.urdf", ROD), ("g.toml", SCENE),
                               ("h.toml", SCENE.replace("rod.urdf", "robots/puma560/puma560.urdf").replace(
                                   '"rod"', '"link1"').replace("hinge", "j1"))):
                reply = lab.upload(name, text, live)
                self.assertEqual(reply.status, 200, reply.body)
            known = live.wait_for("state", lambda s: s["name"] == "h")["notes"]
            live.do("set", changes=[f"body[0].texture={path}/secret.png"])
            notes = live.wait_for("state", lambda s: len(s["notes"]) > len(known))["notes"]
            self.assertIn("may not read the file", notes[-1]["text"])
        running.end()


if __name__ == "__main__":
    main()
