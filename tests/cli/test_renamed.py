"""Names before assets/renamed.json: refused with today's name; recordings that have them are read."""
import json

import recording_format as form
from program import ROOT, data, main
from recording_command import RecordingCommand, held

NAMES = json.loads((ROOT / "assets/renamed.json").read_text())
CAVITY = """
[[body]]
name = "bowl"
fixed = true
position = [0, 0, -40]
shape = { spherical_cavity = { radius = 60 } }
"""
WELL = CAVITY.replace("bowl", "well").replace("spherical_cavity = { radius = 60 }",
                                              "cylindrical_cavity = { radius = 60, length = 200 }")
COUPLINGS = """
[[coupling]]
name = "cushion"
type = "bushing"
link = "rod"
point = [0, 0, -0.5]
stiffness = 50
damping = 1
rotational_stiffness = 2
rotational_damping = 0.1
discretization = "implicit"
[[coupling]]
name = "stop"
type = "torsional"
measure = "joint"
link = "rod"
stiffness = 20
damping = 1
soft_limits = [-0.1, 0.1]
"""


def in_old_words(text):
    for kind, form_of in (("keys", "{} = "), ("values", '"{}"')):
        for old, new in NAMES[kind].items():
            text = text.replace(form_of.format(new), form_of.format(old))
    return text


class Renamed(RecordingCommand):
    def test_an_option_that_was_renamed_is_refused_with_its_new_name(self):
        for old, new in NAMES["options"].items():
            with self.subTest(old):
                self.assertIn(f"'{old}' is now '{new}'",
                              self.twinarm("simulate", "x.toml", f"{old}=1", "--json", code=2).stderr)

    def test_every_new_option_exists(self):
        manual = self.twinarm("help", "--completion").stdout
        for new in NAMES["options"].values():
            self.assertIn(new, manual)

    def test_a_scene_with_old_names_is_refused_with_the_new_ones(self):
        for kind, more, old in (
                ("keys", COUPLINGS, ("treatment", "turn_stiffness", "turn_damping", "outside")),
                ("keys", CAVITY + WELL, ("hollow_sphere", "hollow_cylinder"))):
            reported = self.refused("simulate", self.write("old.toml", in_old_words(held(10, 1) + more)))
            for name in old:
                self.assertIn(f"'{name}' is now '{NAMES[kind][name]}'", reported)
        for old, new in NAMES["values"].items():
            scene = self.write("old.toml", data("held.toml").replace('"torsional"', f'"{old}"'))
            self.assertIn(f"'{old}' is now '{new}'", self.refused("simulate", scene))

    def test_an_overlay_or_curve_that_was_renamed_is_refused_with_its_new_name(self):
        scene = ROOT / "assets/scenes/hand_and_obstacles.toml"
        for old, new in NAMES["choices"].items():
            reported = [self.refused("render", scene, option, old, "--png", self.folder / "a.png")
                        for option in ("--show", "--plot")]
            self.assertTrue(any(f"'{old}' is now '{new}'" in text for text in reported), reported)

    def test_a_recording_of_a_scene_with_old_names_is_inspected_and_exported_and_goes_on_with_the_same_bits(self):
        file = self.record(held(10, 1) + COUPLINGS + CAVITY + WELL, "--duration", 0.05)
        today = self.exported(file)
        seen = self.json_of("inspect", file)
        blocks = [(kind, in_old_words(payload.decode()).encode() if kind == "D" else payload)
                  for kind, payload in form.blocks(file.read_bytes())]
        self.assertIn(b"turn_stiffness", b"".join(payload for _, payload in blocks))
        file.write_bytes(form.file_of(blocks))
        self.assertEqual(self.exported(file), today)
        self.assertEqual(self.json_of("inspect", file), seen)
        self.goes_on_with_the_same_bits(file, [0, 0.02])


if __name__ == "__main__":
    main()
