"""The bytes of a recording, by a reader and writer of its own (recording_format.py), and damage."""
import json
import random

import recording_format as form
from program import main, run
from recording_command import BOXES, RecordingCommand, held

TIED = held(4e6, 0) + BOXES.replace("step = 0.002", "")


class Bytes(RecordingCommand):
    def test_every_kind_of_block_is_written_again_byte_for_byte(self):
        """A run with contacts and a coupling that comes to an alarm: all kinds are there."""
        file = self.record(TIED, "--duration", 1, "--step", 1.0001e-3, "--record-every", 0.05, "--energy-bound", "inf",
                           "--post-mortem", self.folder / "last.twinrec", code=3)
        data = file.read_bytes()
        found = form.blocks(data)
        self.assertEqual({kind for kind, _ in found}, set("HDNMFEA"))
        self.assertEqual(found[0][0], "H")
        again = [found[0]]
        for kind, payload in found[1:]:
            if kind == "F":
                payload = form.written(form.FRAME, form.decoded(form.FRAME, payload))
            again.append((kind, payload))
        self.assertEqual(form.file_of(again), data)

    def test_the_header_describes_itself(self):
        file = self.record(TIED, "--duration", 0.02, "--energy-bound", "inf")
        found = form.blocks(file.read_bytes())
        header = form.header(found)
        self.assertEqual(header["run"]["energy_bound"], "inf")
        self.assertEqual(len(header["files"]), sum(kind == "D" for kind, _ in found))
        self.assertEqual(len(header["columns"]), len(form.decoded(form.FRAME, found[-2][1])[3]))
        self.assertEqual([field.split()[0] for field in header["frame"]],
                         ["step", "t", "hash", "values", "pulls", "contacts", "rows", "works",
                          "momentum_rows", "momenta", "memory"])

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
        earlier = json.dumps(header | {"run": without(without(run_, "density"), "min_mass")})
        for text in (nested(8), whole.ljust(most), earlier):
            with_text(text)
            self.assertEqual(self.exported(file)["format"], 3)
        refused = {"9 deep": nested(9), "100,000 deep": "[" * 100_000, "32 MiB and a byte": whole.ljust(most + 1),
                   "no object": "[]", "cut short": whole[:-1],
                   "frames of another layout": json.dumps(header | {"frame": [*header["frame"], "heat float64 K"]}),
                   **{f"no {key}": json.dumps(without(header, key)) for key in header},
                   **{f"no run.{key}": json.dumps(header | {"run": without(run_, key)}) for key in run_
                      if key not in ("density", "min_mass")},  # recordings made before lack these
                   **{f"{key} of another type": json.dumps(header | {key: {}}) for key in header}}
        for name, text in refused.items():
            with self.subTest(name):
                with_text(text)
                self.assertIn(str(file), self.refused_as("recording.header", "export", file))

    def test_a_recording_of_version_2_is_read_and_replayed(self):
        """As programs wrote it before headers described themselves."""
        file = self.record(TIED, "--duration", 0.05, "--energy-bound", "inf")
        before = self.exported(file)
        file.write_bytes(form.as_version_2(file.read_bytes()))
        self.assertEqual(before.pop("format"), 3)
        after = self.exported(file)
        self.assertEqual(after.pop("format"), 2)
        self.assertEqual(after, before)
        self.goes_on_with_the_same_bits(file, (0, 0.02))

    def test_a_file_made_by_hand_is_read(self):
        """The first frames of a recording, put together anew, with the end's own words."""
        file = self.record(BOXES, "--duration", 0.1)
        found = form.blocks(file.read_bytes())
        keep = [b for b in found if b[0] in "HDNM"] + [b for b in found if b[0] == "F"][:5]
        file.write_bytes(form.file_of(keep + [("E", "by hand, µ".encode())]))
        exported = self.exported(file)
        self.assertEqual(exported["end"], "by hand, µ")
        self.assertEqual(len(exported["frames"]), 5)
        for frame, (_, payload) in zip(exported["frames"], keep[-5:]):
            values = form.decoded(form.FRAME, payload)
            self.assertEqual(frame["step"], values[0])
            self.assertEqual(frame["hash"], f"{values[2]:016x}")
            self.assertEqual(frame["values"], values[3])
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
        chance = random.Random(7)
        for trial in range(40):
            n = frame if trial % 2 else 0
            payload = bytearray(found[n][1])
            for _ in range(3):
                payload[chance.randrange(len(payload))] = chance.choice((0, 1, 127, 255))
            if trial % 5 == 0:
                payload = payload[:chance.randrange(len(payload))]
            made = list(found)
            made[n] = (found[n][0], bytes(payload))
            file.write_bytes(form.file_of(made))
            for form_of_export in ("--json", "--csv"):
                result = run("export", file, form_of_export, errors="replace")
                self.assertIn(result.returncode, (0, 2), f"{trial}: {result.stderr[:500]}")


if __name__ == "__main__":
    main()
