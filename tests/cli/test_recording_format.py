"""The bytes of a recording, by a reader and writer of its own (recording_format.py), and damage."""
import json
import math
import random
import struct

import recording_format as form
from program import ROOT, SCENES, main, run
from recording_command import BOXES, RecordingCommand, held

TIED = held(4e6, 0) + BOXES.replace("step = 0.002", "")


class Bytes(RecordingCommand):
    def test_every_kind_of_block_is_written_again_byte_for_byte(self):
        """A run with contacts and a coupling that comes to an alarm: all kinds are there."""
        file = self.record(TIED, "--duration", 1, "--step", 1.0001e-3, "--record-every", 0.05, "--energy-bound", "inf",
                           "--post-mortem", self.folder / "last.twinrec", code=3)
        data = file.read_bytes()
        found = form.blocks(data)
        self.assertEqual({kind for kind, _ in found}, set("HDNMFEAS"))
        self.assertEqual(found[0][0], "H")
        coded = iter(form.frame_blocks(form.frames(found)))
        again = [next(coded) if kind in "SF" else (kind, payload) for kind, payload in found]
        self.assertEqual(form.file_of(again), data)

    def test_the_header_describes_itself(self):
        file = self.record(TIED, "--duration", 0.02, "--energy-bound", "inf")
        found = form.blocks(file.read_bytes())
        header = form.header(found)
        self.assertEqual(header["run"]["energy_bound"], "inf")
        self.assertEqual(len(header["files"]), sum(kind == "D" for kind, _ in found))
        self.assertEqual(len(header["columns"]), len(form.frames(found)[-1][0][4]))
        self.assertEqual([field.split()[0] for field in header["frame"]],
                         ["step", "t", "q", "qd", "values", "pulls", "contacts", "works", "momenta", "rows",
                          "momentum_rows"])

    def test_what_a_newer_program_adds_to_the_header_is_skipped(self):
        file = self.record(BOXES, "--duration", 0.02)
        found = form.blocks(file.read_bytes())
        before = self.exported(file)
        header = form.header(found) | {"new": {"list": [1, 2]}}
        header["run"]["newer"] = True
        file.write_bytes(form.file_of(form.with_header(found, header)))
        self.assertEqual(self.exported(file), before)

    def test_a_header_is_read_within_its_bounds_and_refused_beyond_them_or_without_a_key(self):
        """At most 32 MiB, and 8 deep; its checksum is right."""
        file = self.record(BOXES, "--duration", 0.02)
        found = form.blocks(file.read_bytes())
        header = form.header(found)
        run_ = header["run"]

        def with_text(text):
            file.write_bytes(form.file_of([("H", text.encode()), *found[1:]]))

        def nested(depth):
            return json.dumps(header | {"new": json.loads("[" * (depth - 1) + "]" * (depth - 1))})

        def without(table, key):
            return {name: value for name, value in table.items() if name != key}
        whole, most = json.dumps(header), 32 << 20
        earlier = json.dumps(header | {"run": without(without(without(run_, "density"), "min_mass"), "budget")})
        for text in (nested(8), whole.ljust(most), earlier):
            with_text(text)
            self.assertEqual(self.exported(file)["format"], 4)
        refused = {"9 deep": nested(9), "100,000 deep": "[" * 100_000, "32 MiB and a byte": whole.ljust(most + 1),
                   "no object": "[]", "cut short": whole[:-1],
                   "frames of another layout": json.dumps(header | {"frame": [*header["frame"], "heat float64 K"]}),
                   **{f"no {key}": json.dumps(without(header, key)) for key in header},
                   **{f"no run.{key}": json.dumps(header | {"run": without(run_, key)}) for key in run_
                      if key not in ("density", "min_mass", "budget")},  # recordings made before lack these
                   **{f"{key} of another type": json.dumps(header | {key: {}}) for key in header}}
        for name, text in refused.items():
            with self.subTest(name):
                with_text(text)
                self.assertIn(str(file), self.refused_as("recording.header", "export", file))

    def test_recordings_of_versions_2_and_3_are_read_inspected_and_replayed(self):
        """As programs wrote them before frames were compressed, and before headers described themselves."""
        file = self.record(TIED, "--duration", 0.0512, "--step", 1e-4, "--energy-bound", "inf", "--record-every", 64e-4)
        data, before = file.read_bytes(), self.exported(file)
        inspected = self.json_of("inspect", file, "--at", 0.02)
        self.assertEqual(before.pop("format"), 4)
        for frame, (_, memory) in zip(before["frames"], form.frames(form.blocks(data))):
            frame["hash"] = f"{form.fnv(memory):016x}"
        for version, made in ((3, form.file_of(form.as_version_3(data), 3)), (2, form.as_version_2(data))):
            file.write_bytes(made)
            after = self.exported(file)
            self.assertEqual(after.pop("format"), version)
            self.assertEqual(after, before)
            self.assertEqual(self.json_of("inspect", file, "--at", 0.02), inspected)
            self.goes_on_with_the_same_bits(file, (0, 0.02))

    def test_recordings_that_an_older_program_wrote_are_read(self):
        files = sorted((ROOT / "tests/fuzz/seeds/recording").glob("*.twinrec"))
        versions = {file: file.read_bytes()[8] for file in files}
        self.assertLessEqual({2, 3}, set(versions.values()))
        for file, version in versions.items():
            if version == form.VERSION:
                continue
            with self.subTest(file.name):
                exported = self.exported(file)
                payloads = [payload for kind, payload in form.blocks(file.read_bytes(), version) if kind == "F"]
                self.assertEqual([exported["format"], len(exported["frames"])], [version, len(payloads)])
                for frame, payload in zip(exported["frames"], payloads):
                    values = form.decoded(form.FRAME_3, payload)
                    self.assertEqual([frame["step"], frame["t"], frame["values"]], [values[0], values[1], values[3]])
                    self.assertEqual(frame["hash"], f"{values[2]:016x}")

    def test_a_file_made_by_hand_is_read(self):
        """The first frames of a recording, put together anew, with the end's own words."""
        file = self.record(BOXES, "--duration", 0.1)
        found = form.blocks(file.read_bytes())
        keep = form.frames(found)[:5]
        file.write_bytes(form.file_of([b for b in found if b[0] in "HDNM"] + form.frame_blocks(keep) +
                                      [("E", "by hand, µ".encode())]))
        exported = self.exported(file)
        self.assertEqual(exported["end"], "by hand, µ")
        self.assertEqual(len(exported["frames"]), 5)
        for frame, (values, _) in zip(exported["frames"], keep):
            self.assertEqual(frame["step"], values[0])
            self.assertEqual(frame["hash"], f"{form.state_hash(values):016x}")
            self.assertEqual(frame["values"], values[4])
            self.assertEqual(list(frame["energy_balance"].values()), values[7])
        self.goes_on_with_the_same_bits(file, (0,))

    def test_damage_anywhere_is_reported_and_never_a_crash(self):
        file = self.record(BOXES, "--duration", 0.06)
        data, chance = file.read_bytes(), random.Random(5)
        for trial in range(60):
            bad = bytearray(data)
            at = chance.randrange(8) if trial < 4 else chance.randrange(len(bad))
            bad[at] ^= 1 << chance.randrange(8)
            if trial % 3 == 0:
                bad = bad[:chance.randrange(len(bad))]
            file.write_bytes(bytes(bad))
            result = run("export", file, "--csv")
            self.assertIn(result.returncode, (0, 2), f"{at}: {result.stderr}")
            self.assertTrue(result.stderr, f"byte {at} of {len(data)}")

    def test_what_lies_behind_a_valid_checksum_but_is_invalid_is_reported(self):
        """Sizes and numbers of names that are beyond all bounds, with checksums that fit."""
        file = self.record(BOXES, "--duration", 0.02)
        found = form.blocks(file.read_bytes())
        frame = next(n for n, b in enumerate(found) if b[0] == "F")
        start, lengths, kept = form.parts_of_frame(found[frame][1])
        plain = form.Coder().decoded(lengths, kept)
        chance = random.Random(7)
        for trial in range(80):
            n = frame if trial % 4 else 0
            payload = bytearray([found[0][1], plain, lengths, kept][trial % 4])
            for _ in range(3):
                payload[chance.randrange(len(payload))] = chance.choice((0, 1, 127, 255))
            if trial % 5 == 0:
                payload = payload[:chance.randrange(len(payload))]
            made = list(found)
            payload = bytes(payload)
            coded = [(), form.Coder().encoded(payload), (payload, kept), (lengths, payload)][trial % 4]
            made[n] = (found[n][0], form.frame_payload(start, *coded) if coded else payload)
            file.write_bytes(form.file_of(made))
            for form_of_export in ("--json", "--csv"):
                result = run("export", file, form_of_export, errors="replace")
                self.assertIn(result.returncode, (0, 2), f"{trial}: {result.stderr[:500]}")

    def test_blocks_that_claim_to_be_larger_than_allowed_are_refused_before_they_are_decompressed(self):
        """At most 256 MiB: of zeros, which compress to little, and as a number alone."""
        file = self.record(BOXES, "--duration", 0.02)
        found = form.blocks(file.read_bytes())
        memory, frame = (next(n for n, block in enumerate(found) if block[0] == kind) for kind in "SF")
        whole = form.compressed(b"")
        zeros = form.compressed(bytes((256 << 20) + 1))
        claimed = whole[:4] + bytes([0xe0]) + struct.pack("<Q", 1 << 60) + whole[6:]
        counted = form.compressed(struct.pack("<Q", 1 << 60) + bytes(1000))
        for n, start in ((memory, b""), (frame, found[frame][1][:16])):
            for payload in (zeros, claimed, counted if n == frame else b"", b""):
                made = list(found)
                made[n] = (found[n][0], start + payload)
                file.write_bytes(form.file_of(made))
                self.assertIn("frame 0", self.refused_as("recording.numbers", "export", file))

    def test_frames_without_a_keyframe_are_not_read(self):
        file = self.record(BOXES, "--duration", 0.3, "--step", 0.001)
        found = form.blocks(file.read_bytes())
        keyframes = [n for n, block in enumerate(found) if block[0] == "S"]
        self.assertEqual(len(keyframes), 5)  # 0, 64, .. of 300 steps
        for gone, frames in ((2, 128), (4, 256)):
            file.write_bytes(form.file_of([b for n, b in enumerate(found) if n != keyframes[gone]]))
            exported = self.exported(file)
            self.assertEqual(len(exported["frames"]), frames)
            self.assertIn("keyframe", exported["notes"][0])
        file.write_bytes(form.file_of([b for b in found if b[0] != "S"]))
        self.refused_as("recording.cut-short", "export", file)

    def test_a_state_that_this_program_does_not_repeat_bit_by_bit_is_reported_and_inspected(self):
        """A velocity of one frame differs by a rounding, as if another version had recorded it."""
        file = self.record(BOXES, "--duration", 0.02)
        found = form.blocks(file.read_bytes())
        frames = form.frames(found)
        velocities, t = frames[3][0][3], frames[3][0][1]
        velocities[2] = math.nextafter(velocities[2], 1)
        file.write_bytes(form.file_of([b for b in found if b[0] in "HDNM"] + form.frame_blocks(frames) + found[-1:]))
        answer = self.replayed(file, code=1)
        self.assertEqual([answer["first_different"], answer["compared"] - answer["equal"]], [t, 1])
        for command, code in (("replay", "--from"), 1), (("inspect", "--at"), 0):
            self.assertIn("same version", self.twinarm(command[0], file, command[1], t, code=code).stderr)

    def test_55_boxes_with_400_contact_points_take_less_than_15_kb_a_step(self):
        scene = (SCENES / "pyramid.toml").read_text()
        file = self.record(scene, "--duration", 0.3)
        self.assertEqual(len(self.exported(file)["frames"][-1]["contacts"]), 400)
        self.assertLess(file.stat().st_size, 300 * 15_000)


if __name__ == "__main__":
    main()
