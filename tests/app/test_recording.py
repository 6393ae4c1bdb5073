#!/usr/bin/env python3
"""Recordings: `simulate --record`, `export`, `replay`, `inspect RECORDING`, and what a run that stops
by itself says.

    test_recording.py PATH/TO/twinarm
"""
import csv
import io
import json
import math
import os
import pathlib
import signal
import struct
import subprocess
import sys
import time
import unittest
import zlib

import robot_command
from robot_command import PENDULUM, RobotCommand, joint, link, robot, slider

DOUBLE = robot('<link name="base"/>', link("upper"), link("lower"),
               joint("shoulder", "continuous", "base", "upper", axis="0 1 0",
                     more='<dynamics damping="0.1" friction="0.3"/>'),
               joint("elbow", "continuous", "upper", "lower", xyz="0 0 -1", axis="1 0 0"))
ROD = robot('<link name="base"/>', link("rod", 1, (0, 0, 0), (1, 0, 0, 1, 0, 0.5)),
            joint("hinge", "continuous", "base", "rod"))
HELD = """
[[robot]]
name = "arm"
model = "test.urdf"
q = { hinge = 0.5 }
[[coupling]]
name = "pull"
type = "torsional"
measure = "joint"
link = "rod"
stiffness = %s
damping = %s
treatment = "explicit"
%s
target = { q = { hinge = 0.0 } }
"""
BOXES = """
step = 0.002
%s
[[body]]
name = "floor"
fixed = true
shape = { halfspace = { normal = [0, 0, 1], offset = 0 } }
[[body]]
name = "low"
shape = { box = { size = [0.2, 0.2, 0.2] } }
mass = 1
position = [0, 0, 0.12]
linear_velocity = [0.8, 0, 0]
angular_velocity = [0, 0, 3]
[[body]]
name = "high"
shape = { box = { size = [0.2, 0.2, 0.2] } }
mass = 1
position = [0.03, 0.01, 0.35]
restitution = 0.3
"""


class RecordingCommand(RobotCommand):
    def twinarm(self, *arguments, code=0):
        result = subprocess.run([robot_command.PROGRAM, *map(str, arguments)], cwd=self.folder,
                                capture_output=True, text=True, timeout=120)
        self.assertEqual(result.returncode, code, result.stderr + result.stdout[:2000])
        return result

    def record(self, text, *options, name="run.twinrec", urdf=ROD, state=None, code=0):
        is_scene = not text.startswith("<robot")
        (self.folder / "test.urdf").write_text(urdf if is_scene else text)
        model = self.folder / ("scene.toml" if is_scene else "test.urdf")
        if is_scene:
            model.write_text(text)
        arguments = ["simulate", model, *options, "--json", "--record", self.folder / name]
        if state is not None:
            (self.folder / "state.json").write_text(json.dumps(state))
            arguments += ["--state", self.folder / "state.json"]
        self.simulated = self.twinarm(*arguments, code=code)
        return self.folder / name

    def exported(self, file):
        return json.loads(self.twinarm("export", file, "--json").stdout)

    def replayed(self, file, *options, code=0):
        return json.loads(self.twinarm("replay", file, *options, "--json", code=code).stdout)

    def refused(self, *arguments):
        result = self.twinarm(*arguments, code=2)
        return result.stderr

    def goes_on_with_the_same_bits(self, file, times):
        frames = self.exported(file)["frames"]
        for t in times:
            answer = self.replayed(file, "--from", t)
            at = max(n for n, f in enumerate(frames) if f["t"] <= t + 1e-12)
            self.assertEqual(answer["hash"], frames[at]["hash"])
            self.assertEqual(answer["hash_again"], answer["hash"])
            self.assertEqual(answer["compared"], len(frames) - 1 - at)
            self.assertEqual(answer["equal"], answer["compared"], answer)
            self.assertTrue(answer["bit_exact"])


class Recordings(RecordingCommand):
    def test_a_robot_goes_on_with_the_same_bits_from_any_step_by_every_integrator(self):
        state = {"q": {"shoulder": 1.0, "elbow": 0.5}, "tau": {"elbow": 0.2},
                 "wrenches": [{"link": "lower", "point": [0, 0, -1.5], "force": [1, 0.5, 0]}]}
        for integrator in ("semi-implicit", "semi-implicit-xv", "verlet", "rk4", "dopri5",
                           "implicit-midpoint"):
            file = self.record(DOUBLE, "--duration", 0.3, "--step", 0.01, "--integrator",
                               integrator, state=state)
            self.goes_on_with_the_same_bits(file, (0, 0.05, 0.21))

    def test_contacts_go_on_with_the_same_bits(self):
        for contact in ("rigid", "compliant", "event"):
            file = self.record(BOXES % f'contact = "{contact}"', "--duration", 0.5)
            self.goes_on_with_the_same_bits(file, (0, 0.1, 0.3))
            frames = self.exported(file)["frames"]
            self.assertTrue(any(f["contacts"] for f in frames), contact)

    def test_a_held_force_goes_on_with_the_same_bits_between_two_evaluations(self):
        file = self.record(HELD % (50, 2, "rate = 100"), "--duration", 0.2, "--step", 0.001)
        self.goes_on_with_the_same_bits(file, (0, 0.033, 0.104))

    def test_a_recording_stands_alone_where_its_files_have_changed_or_are_gone(self):
        file = self.record(HELD % (50, 2, ""), "--duration", 0.2)
        (self.folder / "test.urdf").unlink()
        (self.folder / "scene.toml").write_text("step = 5")
        self.goes_on_with_the_same_bits(file, (0.1,))

    def test_a_fork_is_the_run_that_the_changed_scene_gives(self):
        """Forked at t = 0 it must be, number by number, a run of the edited scene."""
        file = self.record(HELD % (50, 2, ""), "--duration", 0.3)
        for path in ("coupling.stiffness", "coupling[0].stiffness", "coupling.pull.stiffness"):
            fork = self.replayed(file, "--from", 0, "--set", f"{path}=800")
            self.assertTrue(fork["bit_exact"])
            by_name = {b["name"]: b for b in fork["branches"]}
            other = self.exported(self.record(HELD % (800, 2, ""), "--duration", 0.3,
                                              name="other.twinrec"))
            column = [c["name"] for c in other["columns"]].index("q/hinge")
            wanted = [f["values"][column] for f in other["frames"]]
            self.assertEqual(by_name["fork"]["values"]["q/hinge[rad]"], wanted)
            self.assertNotEqual(by_name["recorded"]["values"]["q/hinge[rad]"], wanted)
        table = self.twinarm("replay", file, "--from", 0.1, "--set", "coupling.stiffness=800")
        self.assertIn("fork q/hinge[rad]", table.stdout)

    def test_what_a_fork_cannot_change_is_refused(self):
        file = self.record(HELD % (50, 2, ""), "--duration", 0.1)
        for change, words in (("coupling.stifness=1", "stifness"), ("step=0.1", "grid"),
                              ("couplin.stiffness=1", "'coupling'"), ("nonsense", "PATH=VALUE"),
                              ("coupling[7].stiffness=1", "no such"),
                              ("coupling.stiffness=-1", "negative")):
            self.assertIn(words, self.refused("replay", file, "--set", change))
        self.assertIn("--from", self.refused("replay", file, "--from", 5))

    def test_the_ledger_and_the_states_are_those_that_simulate_prints(self):
        file = self.record(BOXES % "", "--duration", 0.4)
        printed = json.loads(self.simulated.stdout)
        exported = self.exported(file)
        last = exported["frames"][-1]
        self.assertEqual(last["ledger"], printed["ledger"])
        names = [c["name"] for c in exported["columns"]]
        sample = printed["samples"][-1]
        self.assertEqual(last["values"][names.index("kinetic_energy")], sample["kinetic_energy"])
        for axis in range(3):
            self.assertEqual(last["values"][names.index(f"links/low/{'xyz'[axis]}")],
                             sample["links"]["low"]["position"][axis])

    def test_the_csv_has_units_in_its_header_and_the_numbers_of_the_json(self):
        file = self.record(BOXES % "", "--duration", 0.3)
        rows = list(csv.DictReader(io.StringIO(self.twinarm("export", file, "--csv").stdout)))
        frames = self.exported(file)["frames"]
        self.assertEqual(len(rows), len(frames))
        self.assertTrue(all(name.endswith("]") for name in rows[0]), list(rows[0]))
        self.assertEqual([float(r["t[s]"]) for r in rows], [f["t"] for f in frames])
        self.assertEqual(float(rows[-1]["ledger/gravity[J]"]), frames[-1]["ledger"]["gravity"])
        pushed = [c["force"][2] for c in frames[-1]["contacts"] if c["pair"] == "contact/floor-low"]
        self.assertAlmostEqual(float(rows[-1]["contact/floor-low/z[N]"]), sum(pushed))

    def test_record_every_keeps_fewer_frames_and_the_end(self):
        file = self.record(PENDULUM, "--duration", 0.105, "--step", 0.01, "--record-every", 0.02)
        times = [f["t"] for f in self.exported(file)["frames"]]
        self.close(times, [0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.105])
        self.goes_on_with_the_same_bits(file, (0.05,))

    def test_recording_does_not_change_the_run(self):
        self.record(BOXES % "", "--duration", 0.3)
        recorded = self.simulated.stdout
        plain = self.twinarm("simulate", self.folder / "scene.toml", "--duration", 0.3, "--json")
        self.assertEqual(plain.stdout, recorded)


class Damage(RecordingCommand):
    def frame_ends(self, data):
        """(offset behind each block, its kind), by the layout in docs/recording.md."""
        at, ends = 12, []
        while at < len(data):
            size = struct.unpack_from("<I", data, at + 1)[0]
            payload_end = at + 5 + size
            self.assertEqual(struct.unpack_from("<I", data, payload_end)[0],
                             zlib.crc32(data[at:payload_end]))
            ends.append((payload_end + 4, chr(data[at])))
            at = payload_end + 4
        return ends

    def test_what_is_whole_of_a_file_cut_short_anywhere_is_kept_and_said(self):
        file = self.record(PENDULUM, "--duration", 0.05, "--step", 0.01, state={"q": {"hinge": 1}})
        data = file.read_bytes()
        ends = self.frame_ends(data)
        frames = [end for end, kind in ends if kind == "F"]
        self.assertEqual(len(frames), 6)
        for cut in (frames[0], frames[2] + 1, frames[4] - 1, len(data) - 1):
            file.write_bytes(data[:cut])
            exported = self.exported(file)
            self.assertEqual(len(exported["frames"]), sum(end <= cut for end in frames))
            self.assertTrue(any("cut short" in n or "mark of its end" in n
                                for n in exported["notes"]), exported["notes"])
        for cut in (0, 5, 11, 12, 20, frames[0] - 1):
            file.write_bytes(data[:cut])
            self.assertIn(str(file), self.refused("export", file, "--csv"))

    def test_a_flipped_bit_ends_what_is_read_and_is_said(self):
        file = self.record(PENDULUM, "--duration", 0.05, "--step", 0.01, state={"q": {"hinge": 1}})
        data = bytearray(file.read_bytes())
        frames = [end for end, kind in self.frame_ends(bytes(data)) if kind == "F"]
        data[frames[2] + 30] ^= 4
        file.write_bytes(data)
        exported = self.exported(file)
        self.assertEqual(len(exported["frames"]), 3)
        self.assertTrue(any("checksum" in n and "3 frames" in n for n in exported["notes"]))
        self.goes_on_with_the_same_bits(file, (0.01,))

    def test_a_newer_format_and_what_is_no_recording_are_refused(self):
        file = self.record(PENDULUM, "--duration", 0.02)
        data = bytearray(file.read_bytes())
        data[8:12] = struct.pack("<I", 7)
        file.write_bytes(data)
        for command in (["export", file, "--csv"], ["replay", file], ["inspect", file]):
            error = self.refused(*command)
            self.assertIn("version 7", error)
            self.assertIn("version 1", error)
        file.write_bytes(b"not at all")
        self.assertIn("no recording", self.refused("export", file, "--csv"))
        self.assertIn("cannot be read", self.refused("export", self.folder / "none", "--csv"))

    def test_a_run_that_is_killed_leaves_what_it_had_flushed(self):
        (self.folder / "test.urdf").write_text(PENDULUM)
        file = self.folder / "killed.twinrec"
        process = subprocess.Popen(
            [robot_command.PROGRAM, "simulate", self.folder / "test.urdf", "--duration", "1e4",
             "--record", file], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        part = pathlib.Path(str(file) + ".part")
        deadline = time.time() + 30
        while time.time() < deadline and not (part.exists() and part.stat().st_size > 100_000):
            time.sleep(0.05)
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.assertFalse(file.exists())
        result = self.twinarm("export", file, "--csv")
        self.assertIn(".part", result.stderr)
        self.assertGreater(len(result.stdout.splitlines()), 100)
        answer = self.replayed(file, "--from", 0.01)
        self.assertTrue(answer["bit_exact"])
        self.assertGreater(answer["compared"], 100)

    def test_ctrl_c_leaves_a_whole_recording(self):
        (self.folder / "test.urdf").write_text(PENDULUM)
        file = self.folder / "stopped.twinrec"
        process = subprocess.Popen(
            [robot_command.PROGRAM, "simulate", self.folder / "test.urdf", "--duration", "1e4",
             "--record", file], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(0.7)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=20), 130)
        self.assertEqual(self.exported(file)["end"], "interrupted")


class Instants(RecordingCommand):
    def test_an_instant_is_inspected_as_the_state_file_of_that_instant_is(self):
        state = {"q": {"shoulder": 1.0}, "tau": {"elbow": 0.2}}
        file = self.record(DOUBLE, "--duration", 0.1, state=state)
        recorded = json.loads(self.twinarm("inspect", file, "--at", 0.05, "--json").stdout)
        printed = json.loads(self.twinarm(
            "simulate", self.folder / "test.urdf", "--state", self.folder / "state.json",
            "--duration", 0.1, "--at", 0.05, "--json").stdout)["samples"][0]
        (self.folder / "then.json").write_text(
            json.dumps({"q": printed["q"], "qd": printed["qd"], "tau": state["tau"]}))
        wanted = json.loads(self.twinarm("inspect", self.folder / "test.urdf", "--state",
                                         self.folder / "then.json", "--json").stdout)
        self.assertEqual(recorded["passes"], wanted["passes"])
        self.assertEqual(recorded["balance"], wanted["balance"])

    def test_the_forces_on_a_box_at_an_instant_of_a_scene_balance(self):
        file = self.record(BOXES % "", "--duration", 0.4)
        answer = json.loads(self.twinarm("inspect", file, "--at", 0.3, "--json").stdout)
        by_body = {b["body"]: b for b in answer["balance"]}
        self.assertLess(by_body["low"]["residual"], 1e-10)
        self.assertTrue(any(w["source"].startswith("contact/")
                            for w in by_body["low"]["wrenches"]))

    def test_times_outside_and_options_that_do_not_go_are_refused(self):
        file = self.record(PENDULUM, "--duration", 0.1)
        self.assertIn("--at", self.refused("inspect", file, "--at", 3))
        self.assertIn("--at", self.refused("inspect", self.folder / "test.urdf", "--at", 0))


class PostMortems(RecordingCommand):
    def test_a_spring_above_its_limit_is_named_and_the_remedy_holds(self):
        """One spring on I = 0.5 without damper: semi-implicit Euler holds up to w h = 2."""
        inertia, h, k = 0.5, 0.001, 4e6
        file = self.folder / "last.twinrec"
        self.record(HELD % (k, 0, ""), "--duration", 1, "--step", h, "--post-mortem", file, code=3)
        found = json.loads(self.simulated.stdout)["post_mortem"]
        suspect = found["suspects"][0]
        self.assertIn("'pull'", suspect["name"])
        self.close(suspect["w_h"], math.sqrt(k / inertia) * h, 1e-9)
        self.close(suspect["limit"], 2, 1e-4)
        self.close(suspect["largest_step"], 2 / math.sqrt(k / inertia), 1e-4)
        self.close(suspect["largest_gain"], 4 * inertia / h ** 2, 1e-3)
        self.assertEqual(found["joint"], "hinge")
        self.assertIn("'pull'", self.simulated.stderr)
        self.assertTrue(found["ledger_row"])
        self.assertGreater(found["ledger_growth"], 1)
        # What it says holds, holds; a little beyond the limit it does not.
        for step, code in ((0.9 * suspect["largest_step"], 0), (1.2 * suspect["largest_step"], 3)):
            self.record(HELD % (k, 0, ""), "--duration", 1, "--step", step, "--post-mortem", file,
                        code=code)
        self.record(HELD % (0.9 * suspect["largest_gain"], 0, ""), "--duration", 1, "--step", h)

    def test_the_last_thousand_steps_are_those_of_the_run(self):
        """A spring a hair beyond its limit, recorded in full beside its post-mortem."""
        k = 4 * 0.5 / 0.001 ** 2 * 1.00002
        last = self.folder / "last.twinrec"
        full = self.record(HELD % (k, 0, ""), "--duration", 60, "--energy-bound", 1e25,
                           "--post-mortem", last, code=3)
        found = json.loads(self.simulated.stdout)["post_mortem"]
        self.assertIn("kinetic energy", found["reason"])
        ours, all_frames = self.exported(last)["frames"], self.exported(full)["frames"]
        self.assertEqual(len(ours), 1000)
        self.assertGreater(len(all_frames), 1500)
        self.assertEqual([f["hash"] for f in ours], [f["hash"] for f in all_frames[-1000:]])
        self.assertEqual(ours[-1]["step"], found["step"])
        # It opens; at such speeds a check by a second way may fall short, and then says so.
        opened = subprocess.run([robot_command.PROGRAM, "inspect", last, "--at",
                                 str(ours[500]["t"]), "--json"], capture_output=True, text=True)
        self.assertIn(opened.returncode, (0, 1), opened.stderr)
        self.assertTrue(json.loads(opened.stdout)["balance"])

    def test_the_damper_of_a_joint_is_named_where_the_integrator_takes_it_explicitly(self):
        self.record(slider(damping=1e5), "--duration", 1, "--integrator", "euler",
                    "--energy-bound", "inf", "--post-mortem", self.folder / "last.twinrec",
                    state={"qd": {"slide": 1}}, code=3)
        found = json.loads(self.simulated.stdout)["post_mortem"]
        self.assertIn("'slide'", found["suspects"][0]["name"])
        self.close(found["suspects"][0]["w_h"], 1e5 / 2.0 * 0.001)
        self.assertEqual(found["suspects"][0]["limit"], 2)

    def test_bad_numbers_are_told(self):
        (self.folder / "test.urdf").write_text(PENDULUM)
        errors = self.refused("simulate", self.folder / "test.urdf", "--duration", 1,
                              "--energy-bound", -1, "--record-every", 0)
        for words in ("--energy-bound", "--record-every", "--record FILE"):
            self.assertIn(words, errors)
        self.assertIn("cannot be written", self.refused(
            "simulate", self.folder / "test.urdf", "--duration", 1, "--record",
            self.folder / "none" / "run.twinrec"))


if __name__ == "__main__":
    robot_command.PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
