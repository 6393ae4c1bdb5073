"""Recordings: `simulate --record`, `export`, `replay`, and files that are damaged."""
import csv
import html
import io
import json
import shutil
import signal
import struct
import unittest
import xml.etree.ElementTree

from program import SCENES, main
from recording_command import BOXES, DOUBLE, DRIVEN, RecordingCommand, held
from robot_command import PENDULUM, joint, link, robot
from whole_files import recorded_blocks


class Recordings(RecordingCommand):
    def test_a_robot_goes_on_with_the_same_bits_from_any_step_by_every_integrator(self):
        state = {"q": {"shoulder": 1.0, "elbow": 0.5}, "tau": {"elbow": 0.2},
                 "wrenches": [{"link": "lower", "point": [0, 0, -1.5], "force": [1, 0.5, 0]}]}
        for integrator in ("semi-implicit", "semi-implicit-xv", "verlet", "rk4", "dopri5", "implicit-midpoint"):
            file = self.record(DOUBLE, "--duration", 0.3, "--step", 0.01, "--integrator", integrator, state=state)
            self.goes_on_with_the_same_bits(file, (0, 0.05, 0.21))

    def test_contacts_go_on_with_the_same_bits(self):
        for contact in ("rigid", "compliant", "event"):
            file = self.record(f'contact = "{contact}"\n' + BOXES, "--duration", 0.5)
            self.goes_on_with_the_same_bits(file, (0, 0.1, 0.3))
            frames = self.exported(file)["frames"]
            self.assertTrue(any(f["contacts"] for f in frames), contact)

    def test_detection_by_fcl_goes_on_with_the_same_bits(self):
        by_fcl = self.record('detection = "fcl"\n' + BOXES, "--duration", 0.5)
        self.goes_on_with_the_same_bits(by_fcl, (0, 0.1, 0.3))
        frames = self.exported(by_fcl)["frames"]
        self.assertTrue(any(f["contacts"] for f in frames))
        self.assertNotEqual(frames, self.exported(self.record(BOXES, "--duration", 0.5))["frames"])

    def test_every_scene_of_the_assets_goes_on_with_the_same_bits(self):
        """Loops, hard contacts with guesses of impulses, couplings, driven bodies."""
        short = {"pyramid": 0.012, "spinning_coin": 0.01, "rattleback": 0.01}
        for scene in sorted(SCENES.glob("*.toml")):
            file = self.folder / "scene.twinrec"
            duration = short.get(scene.stem, 0.06)
            self.twinarm("simulate", scene, "--duration", duration, "--record", file, "--json")
            self.goes_on_with_the_same_bits(file, (duration / 2,))

    def test_mimic_joints_driven_bodies_and_events_go_on_with_the_same_bits(self):
        follower = robot('<link name="base"/>', link("lead"), link("hand"),
                         joint("leader", "revolute", "base", "lead", axis="0 1 0",
                               more='<limit lower="-0.2" upper="0.2" effort="1" velocity="1"/>'),
                         joint("follower", "continuous", "lead", "hand", xyz="0 0 -1", axis="1 0 0",
                               more='<mimic joint="leader" multiplier="2" offset="0.1"/>'))
        for integrator in ("semi-implicit", "rk4", "dopri5", "implicit-midpoint"):
            file = self.record(follower, "--duration", 0.1, "--step", 0.002, "--integrator",
                               integrator, state={"qd": {"leader": 1}})
            self.goes_on_with_the_same_bits(file, (0, 0.05))
        for contact in ("rigid", "event"):  # within its limits, in a scene
            file = self.record('[[robot]]\nname = "arm"\nmodel = "test.urdf"\nqd = { leader = 2 }\n', "--duration", 0.3,
                               "--step", 0.002, "--contact", contact, urdf=follower)
            self.goes_on_with_the_same_bits(file, (0.05, 0.2))
        for integrator in ("rk4", "dopri5", "semi-implicit"):
            file = self.record(DRIVEN, "--duration", 0.1, "--step", 0.002, "--integrator", integrator)
            self.goes_on_with_the_same_bits(file, (0.01, 0.05))

    def test_a_held_force_goes_on_with_the_same_bits_between_two_evaluations(self):
        file = self.record(held(50, 2, "rate = 100\n"), "--duration", 0.2, "--step", 0.001)
        self.goes_on_with_the_same_bits(file, (0, 0.033, 0.104))

    def test_a_recording_of_any_integrator_can_be_inspected_with_a_free_body_and_with_limits(self):
        free = '[[body]]\nname = "rod"\nshape = { box = { size = [0.02, 0.02, 0.2] } }\nmass = 1\n'
        limited = '[[robot]]\nname = "arm"\nmodel = "test.urdf"\n'
        urdf = robot(link("base"), link("arm"), joint("swing", "revolute", "base", "arm"))
        for scene in (free, limited):
            for integrator in ("semi-implicit", "rk4"):
                file = self.record(scene, "--duration", 0.02, "--integrator", integrator, urdf=urdf)
                inspected = self.json_of("inspect", file, "--at", 0.01)
                self.assertTrue(inspected["passes"])

    def test_a_recording_stands_alone_where_its_files_have_changed_or_are_gone(self):
        file = self.record(held(50, 2), "--duration", 0.2)
        (self.folder / "test.urdf").unlink()
        (self.folder / "scene.toml").write_text("step = 5")
        self.goes_on_with_the_same_bits(file, (0.1,))

    def test_a_branch_is_the_run_that_the_changed_scene_gives(self):
        """Forked at t = 0 it must be, number by number, a run of the edited scene."""
        file = self.record(held(50, 2), "--duration", 0.3)
        for path in ("coupling.stiffness", "coupling[0].stiffness", "coupling.pull.stiffness"):
            fork = self.replayed(file, "--from", 0, "--set", f"{path}=800")
            self.assertTrue(fork["bit_exact"])
            by_name = {b["name"]: b for b in fork["branches"]}
            other = self.exported(self.record(held(800, 2), "--duration", 0.3, name="other.twinrec"))
            column = [c["name"] for c in other["columns"]].index("q/hinge")
            wanted = [f["values"][column] for f in other["frames"]]
            self.assertEqual(by_name["branch"]["values"]["q/hinge[rad]"], wanted)
            self.assertNotEqual(by_name["recorded"]["values"]["q/hinge[rad]"], wanted)
            rows = other["frames"][-1]["energy_balance"]
            self.close([fork["energy_balance"][row]["branch"] for row in rows], list(rows.values()))
            own = self.exported(file)["frames"][-1]["energy_balance"]
            self.close([fork["energy_balance"][row]["recorded"] for row in own], list(own.values()))
        table = self.twinarm("replay", file, "--from", 0.1, "--set", "coupling.stiffness=800")
        self.assertLessEqual(max(map(len, table.stdout.splitlines())), 100)
        # One joint moves: it is reported once, not as its link's three coordinates too.
        self.assertEqual(table.stdout.count("[rad]"), 1)
        self.assertNotIn("links/", table.stdout)
        for words in ("q/hinge [rad]", "coupling/pull/spring", "change of kinetic energy",
                      "difference [J]", "momentum, 0.1 to 0.3 s"):
            self.assertIn(words, table.stdout)

    def test_the_rows_of_a_branch_since_then_are_the_change_of_kinetic_energy(self):
        file = self.record(held(50, 2), "--duration", 0.3)
        fork = self.replayed(file, "--from", 0.1, "--set", "coupling.stiffness=800")
        for branch in fork["branches"]:
            kinetic = branch["values"]["kinetic_energy[J]"]
            gained = sum(row[branch["name"]] for row in fork["energy_balance"].values())
            self.close(gained, kinetic[-1] - kinetic[0])

    def test_a_branch_of_free_bodies_shows_each_once_and_one_that_changes_nothing_says_so(self):
        file = self.record(BOXES, "--duration", 0.2)
        table = self.twinarm("replay", file, "--set", "gravity=0,0,-3").stdout
        self.assertLessEqual(max(map(len, table.splitlines())), 100)
        for body in ("low", "high"):
            self.assertEqual(table.count(f"links/{body}/"), 1, table)
        table = self.twinarm("replay", file, "--set", "gravity=0,0,-9.81").stdout
        self.assertIn("no value of the branch differs", table)

    def test_a_run_with_set_is_that_of_the_edited_scene_and_its_recording_contains_the_change(self):
        scene, file = SCENES / "pendulum.toml", self.folder / "set.twinrec"
        options = ["--duration", 2, "--every", 0.5, "--csv"]
        changed = self.twinarm("simulate", scene, *options, "--set", "gravity=0,0,-3", "--record", file).stdout
        self.assertEqual(changed, self.twinarm("simulate", scene, *options, "--gravity", "0,0,-3").stdout)
        self.assertIn("same bits", self.twinarm("replay", file).stdout)

    def test_a_branch_counts_no_work_that_the_old_spring_would_have_done(self):
        """Forked where the arm is held by a box and its target moves on: nothing else moves."""
        scene, file = SCENES / "robot_beside_obstacles.toml", "arm.twinrec"
        self.twinarm("simulate", scene, "--duration", 1.002, "--record", file, "--json")
        fork = self.replayed(file, "--from", 1, "--set", "coupling.pull_arm1.stiffness=800")
        for name, row in fork["energy_balance"].items():
            self.assertLess(abs(row["branch"] - row["recorded"]), 1e-4, name)

    def test_the_plot_of_a_branch_has_both_branches_with_their_units(self):
        file = self.record(held(50, 2), "--duration", 0.3)
        plot = self.folder / "fork.svg"
        self.twinarm("replay", file, "--from", 0.1, "--set", "coupling.stiffness=800", "--plot", plot)
        for words in ("q/hinge [rad]", "time [s]", "[J]", "recorded", "coupling.stiffness=800"):
            self.assertIn(words, plot.read_text())

    def test_of_a_picture_or_mesh_that_cannot_be_decoded_no_bytes_are_recorded(self):
        secret = b"a text that is neither a picture nor a mesh"
        for name in ("secret.png", "secret.stl"):
            (self.folder / name).write_bytes(secret)
        scene = BOXES + '[[body]]\nname = "ball"\nmass = 1\nshape = { sphere = { radius = 0.1 } }\n' \
            'position = [9, 9, 9]\ntexture = "secret.png"\n'
        mesh = PENDULUM.replace('<link name="base"/>', '<link name="base"><visual><geometry>'
                                '<mesh filename="secret.stl"/></geometry></visual></link>')
        for text in (scene, mesh):
            file = self.record(text, "--duration", 0.01)
            self.assertFalse(secret in file.read_bytes(), "its bytes are recorded")
            self.assertIn("same bits", self.twinarm("replay", file).stdout)

    @unittest.skipUnless(shutil.which("gnuplot"), "needs gnuplot")
    def test_the_plot_of_a_branch_is_well_formed_for_any_name_of_a_joint(self):
        name = 'a</title>&"b'
        file = self.record(PENDULUM.replace('name="hinge"', f'name="{html.escape(name)}"'), "--duration", 0.1)
        plot = self.folder / "fork.svg"
        self.twinarm("replay", file, "--set", "gravity=0,5,0", "--plot", plot)
        title = xml.etree.ElementTree.parse(plot).getroot().find("{http://www.w3.org/2000/svg}title")
        self.assertEqual(title.text, f"Recording and branch: q/{name}")

    def test_a_plot_that_could_not_be_drawn_is_refused_before_the_run(self):
        file = self.record(held(50, 2), "--duration", 0.1)
        for name in (self.folder / "test.urdf" / "fork.svg", self.folder / "fork.pdf"):
            error = self.refused("replay", file, "--set", "coupling.stiffness=800", "--plot", name)
            self.assertIn(str(name.parent), error)
        fork = self.folder / "new" / "folder" / "fork.svg"
        self.twinarm("replay", file, "--set", "coupling.stiffness=800", "--plot", fork)
        self.assertTrue(fork.exists())

    def test_faults_of_a_change_name_what_was_typed_and_no_copy_of_the_files(self):
        file = self.record(held(50, 2), "--duration", 0.1)
        for change, code, value in (("coupling.stiffness=-1", "scene.negative", "-1"),
                                    ("coupling.pull.stiffness=stiff", "scene.type", "'stiff'"),
                                    ("coupling.discretization=magic", "scene.choice", "'magic'"),
                                    ("gravity=0,1", "option.count", " 2 "),
                                    ("gravity=down", "option.number", "'down'")):
            error = self.refused_as(code, "replay", file, "--set", change)
            self.assertIn("--set " + change, error)
            self.assertIn(value, error)
            for word in ("twinarm-replay", "--gravity"):
                self.assertNotIn(word, error)
        # What the scene itself does not allow then, by the name of the file that was recorded.
        error = self.refused("replay", file, "--set", "coupling.link=nothing")
        self.assertNotIn("twinarm-replay", error)

    def test_what_a_branch_cannot_change_is_refused(self):
        file = self.record(held(50, 2), "--duration", 0.1)
        for change, code, value in (("coupling.stifness=1", "scene.unknown-key", "stifness"),
                                    ("step=0.1", "change.method", "--set step"),
                                    ("couplin.stiffness=1", "change.unknown-key", "'coupling'"),
                                    ("nonsense", "change.form", "PATH=VALUE"),
                                    ("coupling[7].stiffness=1", "path.no-item", "from 0, below"),
                                    ("coupling.stiffness=-1", "scene.negative", "-1")):
            self.assertIn(value, self.refused_as(code, "replay", file, "--set", change))
        self.assertIn("--from", self.refused_as("recording.time", "replay", file, "--from", 5))

    def test_the_energy_balance_and_the_states_are_those_that_simulate_prints(self):
        file = self.record(BOXES, "--duration", 0.4)
        printed = json.loads(self.simulated.stdout)
        exported = self.exported(file)
        last = exported["frames"][-1]
        self.assertEqual(last["energy_balance"], printed["energy_balance"])
        self.assertEqual(last["momentum"], printed["momentum"])
        names = [c["name"] for c in exported["columns"]]
        sample = printed["samples"][-1]
        self.assertEqual(last["values"][names.index("kinetic_energy")], sample["kinetic_energy"])
        for axis in range(3):
            self.assertEqual(last["values"][names.index(f"links/low/{'xyz'[axis]}")],
                             sample["links"]["low"]["position"][axis])

    def test_the_csv_has_units_in_its_header_and_the_numbers_of_the_json(self):
        file = self.record(BOXES, "--duration", 0.3)
        rows = list(csv.DictReader(io.StringIO(self.twinarm("export", file, "--csv").stdout)))
        frames = self.exported(file)["frames"]
        self.assertEqual(len(rows), len(frames))
        self.assertTrue(all(name.endswith("]") for name in rows[0]), list(rows[0]))
        self.assertEqual([float(r["t[s]"]) for r in rows], [f["t"] for f in frames])
        self.assertEqual(float(rows[-1]["energy_balance/gravity[J]"]), frames[-1]["energy_balance"]["gravity"])
        pushed = [c["force"][2] for c in frames[-1]["contacts"] if c["pair"] == "contact/floor-low"]
        self.assertAlmostEqual(float(rows[-1]["contact/floor-low/z[N]"]), sum(pushed))

    def test_record_every_keeps_fewer_frames_and_the_end(self):
        file = self.record(PENDULUM, "--duration", 0.105, "--step", 0.01, "--record-every", 0.02)
        times = [f["t"] for f in self.exported(file)["frames"]]
        self.close(times, [0, 0.02, 0.04, 0.06, 0.08, 0.1, 0.105])
        self.goes_on_with_the_same_bits(file, (0.05,))

    def test_recording_does_not_change_the_run(self):
        self.record(BOXES, "--duration", 0.3)
        recorded = self.simulated.stdout
        plain = self.twinarm("simulate", self.folder / "scene.toml", "--duration", 0.3, "--json")
        self.assertEqual(plain.stdout, recorded)


class Damage(RecordingCommand):
    def test_what_is_whole_of_a_file_cut_short_anywhere_is_kept_and_reported(self):
        file = self.record(PENDULUM, "--duration", 0.05, "--step", 0.01, state={"q": {"hinge": 1}})
        data = file.read_bytes()
        frames = [end for kind, _, end in recorded_blocks(data) if kind == "F"]
        self.assertEqual(len(frames), 6)
        for cut in (frames[0], frames[2] + 1, frames[4] - 1, len(data) - 1):
            file.write_bytes(data[:cut])
            exported = self.exported(file)
            self.assertEqual(len(exported["frames"]), sum(end <= cut for end in frames))
            self.assertTrue(any("truncated" in n or "end block" in n for n in exported["notes"]), exported["notes"])
        for cut in (0, 5, 11, 12, 20, frames[0] - 1):
            file.write_bytes(data[:cut])
            code = "recording.empty" if cut == 0 else "recording.cut-short"
            for command in ("export", "replay", "inspect"):
                self.assertIn(str(file), self.refused_as(code, command, file))
        file.write_bytes(data + b"more of something else")
        exported = self.exported(file)
        self.assertEqual(len(exported["frames"]), 6)
        self.assertEqual(len(exported["notes"]), 1)
        self.assertIn("22 bytes after", exported["notes"][0])

    def test_a_flipped_bit_ends_what_is_read_and_reported(self):
        file = self.record(PENDULUM, "--duration", 0.05, "--step", 0.01, state={"q": {"hinge": 1}})
        data = bytearray(file.read_bytes())
        frames = [end for kind, _, end in recorded_blocks(data) if kind == "F"]
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
        for command in ("export", "replay", "inspect"):
            error = self.refused_as("recording.version", command, file)
            self.assertIn("version 7", error)
            self.assertIn("versions 2 to 4", error)
        file.write_bytes(b"not at all")
        self.refused_as("recording.form", "export", file)
        self.refused_as("file.missing", "export", self.folder / "none")
        self.refused_as("file.is-folder", "export", self.folder)

    def strike(self, name, blow, size):
        """A long run, once it has written so many bytes."""
        part = self.folder / f"{name}.part"
        self.interrupted("simulate", self.write("test.urdf", PENDULUM), "--duration", 1e4, "--record", name, blow=blow,
                         is_ready=lambda _: part.exists() and part.stat().st_size >= size,
                         code=130 if blow == signal.SIGINT else -blow)
        return self.folder / name

    def test_a_run_that_is_killed_leaves_what_it_had_flushed(self):
        file = self.strike("killed.twinrec", signal.SIGKILL, 100_000)
        self.assertFalse(file.exists())
        result = self.twinarm("export", file, "--csv")
        self.assertIn(".part", result.stderr)
        self.assertGreater(len(result.stdout.splitlines()), 100)
        answer = self.replayed(file, "--from", 0.01)
        self.assertTrue(answer["bit_exact"])
        self.assertGreater(answer["compared"], 100)

    def test_ctrl_c_leaves_a_whole_recording(self):
        file = self.strike("stopped.twinrec", signal.SIGINT, 1)
        self.assertEqual(self.exported(file)["end"], "interrupted")


if __name__ == "__main__":
    main()
