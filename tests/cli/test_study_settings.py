"""Faults of the study's settings: all at once, each with its key, line and remedy."""
import re
import shutil

from program import ROOT, ProgramTest, main

ASSETS = ROOT / "assets"
SHIPPED = (ASSETS / "study/settings.toml").read_text()


class Settings(ProgramTest):
    def faults_of(self, text):
        """By key."""
        assets = self.folder / "assets"
        shutil.copytree(ASSETS / "study", assets / "study")
        (assets / "robots").symlink_to(ASSETS / "robots")
        file = assets / "study/settings.toml"
        file.write_text(text)
        errors = self.faults("study", "--assets", assets, "--out", self.folder / "out")
        self.assertEqual({error["file"] for error in errors}, {str(file)})
        return {error["where"]: error for error in errors}

    def test_settings_with_faults_are_refused_with_all_of_them(self):
        text = SHIPPED
        for key in ("frequency_hz", "contact_stiffness"):
            self.assertIn(f"\n{key} = ", text)
            text = text.replace(f"\n{key} = ", f"\nno_{key} = ")
        self.assertLessEqual({"far_target, frequency_hz", "obstacle, contact_stiffness"}, self.faults_of(text).keys())

    def test_settings_that_nothing_reads_are_reported_with_their_lines_and_the_nearest_key(self):
        lines = []
        wanted = {}  # by where: line, nearest key
        for line in SHIPPED.splitlines():
            lines.append(line)
            for after, where, nearest in (("friction = ", "obstacle, fricton", "friction"),
                                          ('link = "arm2"', "robot.mount, pont", "point"),
                                          ("[operator]", "operator, sead", "seed")):
                if line.startswith(after):
                    lines.append(where.split(", ")[-1] + " = 1")
                    wanted[where] = (len(lines), nearest)
        lines.append("[protocoll]")
        wanted["settings, protocoll"] = (len(lines), "protocol")
        errors = self.faults_of("\n".join([*lines, "rates_hz = [60]"]) + "\n")
        self.assertEqual({where: error["line"] for where, error in errors.items()},
                         {where: line for where, (line, _) in wanted.items()})
        for where, (_, nearest) in wanted.items():
            self.assertEqual(errors[where]["problem"], "unknown key")
            self.assertIn(f"did you mean '{nearest}'?", errors[where]["fix"])

    def test_lists_of_settings_of_the_wrong_kind_or_length_are_refused(self):
        text = SHIPPED
        second = text[text.rindex("[[robot.mount]]"):text.index("# Joint 3")]
        for before, after in (("\nrates_hz = [30, 60,", '\nrates_hz = [30, "60",'),
                              ("\nsweep_times = [0.87,", "\nsweep_times = [nan,"),
                              (', "joint3"]', "]"), (second, ""), ("\nfriction = 0.3", "\nfriction = inf"),
                              ("[0.90, 0.16, 0.42]", "[0.90, 0.16]")):
            self.assertEqual(text.count(before), 1, before)
            text = text.replace(before, after)
        errors = {where: error["problem"] for where, error in self.faults_of(text).items()}
        self.assertEqual(errors, {"protocol, rates_hz": "must be a list of finite numbers",
                                  "protocol, sweep_times": "must be a list of finite numbers",
                                  "robot, turned": "must be a list of 3 texts",
                                  "robot, mount": "must be 2 tables [[robot.mount]]",
                                  "obstacle, friction": "must be finite, is inf",
                                  "obstacle, size": "must be a list of 3 finite numbers, is a list of 2"})

    def test_numbers_outside_their_range_are_refused(self):
        text = SHIPPED
        for key, value in (("held_physics_hz", "0"), ("implicit_damping_ratio", "-1"), ("friction", "-0.1"),
                           ("sweep_times", "[1.0, 0.0]"), ("tremor", "[2e-3, 1e-3]"), ("peak_speed", "[1.0]")):
            text, count = re.subn(rf"(?m)^{key} = .*", f"{key} = {value}", text)
            self.assertEqual(count, 1, key)
        errors = {where: error["problem"] for where, error in self.faults_of(text).items()}
        self.assertEqual(errors, {"protocol, held_physics_hz": "must be positive, is 0",
                                  "protocol, implicit_damping_ratio": "must not be negative, is -1",
                                  "obstacle, friction": "must not be negative, is -0.1",
                                  "protocol, sweep_times": "must be positive numbers",
                                  "operator, tremor": "must be [low, high], both positive",
                                  "operator, peak_speed": "must be a list of 2 finite numbers, is a list of 1"})

    def test_the_rate_at_which_the_report_compares_the_laws_is_required(self):
        errors = self.faults_of(SHIPPED.replace("\nrates_hz = [30, 60,", "\nrates_hz = [30,"))
        self.assertEqual(list(errors), ["protocol, rates_hz"])
        self.assertIn("lacks 60 Hz", errors["protocol, rates_hz"]["problem"])


if __name__ == "__main__":
    main()
