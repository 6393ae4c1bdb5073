"""The command line as people and programs meet it: help, exit codes, all faults at once, Ctrl-C."""
import json
import os
import pathlib
import re
import shutil

from json_schema import check_json
from program import ROOT, ProgramTest, main, run
from robot_command import HAND_COLUMNS
from waiting import TIMEOUT, processor_time, processor_time_of_ended

ASSETS = ROOT / "assets"


class CommandLine(ProgramTest):
    def refused(self, result, *words):
        """Exit code 2 and every one of the words on stderr."""
        self.assertEqual(result.returncode, 2, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def written(self):
        return sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*") if p.is_file())

    def copy_of_assets(self):
        """All but the meshes to look at, which are large and come after what is tested here."""
        copy = self.folder / "assets"
        shutil.copytree(ASSETS, copy, ignore=shutil.ignore_patterns("cad"))
        return copy

    # The whole study

    def test_a_study_gives_its_json_its_report_and_the_numbers_that_it_must_reach(self):
        out = self.folder / "new" / "study"
        trace = ASSETS / "traces" / "synthetic_seed1.csv"
        study = self.json_of("study", "--out", out, "--trace", trace, timeout=4 * TIMEOUT)
        check_json("study", study)
        published = {"E3": (16.6, 23.5, 8.6, 5.2), "E4": (3.4, 6.0, 0.3, 0.6)}
        for name, numbers in published.items():
            run_ = study["runs"][name]
            measured = (*run_["max_deg"].values(), *run_["mean_deg"].values())
            for value, number in zip(measured, numbers):
                self.assertLess(abs(value / number - 1), 0.15, name)
            self.assertEqual(set(run_["gains"]) & {"k1", "b1"}, {"k1", "b1"})
        *papers, far = study["obstacle"]
        self.assertEqual([run_["name"] for run_ in papers], ["linear", "torsional"])
        for obstacle, experiment in zip(papers, ("E4", "E3")):
            self.assertEqual(obstacle["gains"], study["runs"][experiment]["gains"])
            self.assertLess(obstacle["largest_penetration"], 0.5e-3)
        for obstacle in study["obstacle"]:
            self.assertGreater(obstacle["largest_beyond"], 50e-3)
        self.assertGreater(far["target_radius_ratio"], far["target_radius_limit"])
        self.assertGreater(far["limit_exceeded_at"], 0)
        names = {variant["name"] for variant in study["variants"]}
        self.assertLessEqual({"trial/printed-linear/60", "held/printed-linear/60-held",
                              "implicit/linear/1000", "ablation/folded"}, names)
        self.assertEqual(len(study["answer"]), 9)
        self.assertEqual(len(study["findings"]), 73)
        refuted = [finding["measured"] for finding in study["findings"] if not finding["holds"]]
        self.assertEqual(len(refuted), 14)
        for measured in refuted:  # each with its computed explanation
            self.assertRegex(measured, "better than the predicted optimum|another optimum with the same sum"
                                       "|are stable at every pose only up to steps of .* ms, not with")
        for name in ("E1", "E2"):
            self.check_ensemble(study["runs"][name])
        self.assertGreaterEqual(len(study["left_open"]), 16)
        for fit in study["left_open"]:  # what is said of a fit follows from its four numbers
            numbers = [fit["numbers"][f"{kind}{joint}_deg"] for kind in ("max", "mean") for joint in (1, 2)]
            misfit = max(abs(value - number) / 0.05 for value, number in zip(numbers, published[fit["row"]]))
            self.assertAlmostEqual(fit["misfit"], misfit, delta=1e-9 * misfit, msg=fit)
            if len(fit["parameters"]) == 5:  # of which four numbers cannot hold a combination
                self.assertEqual(fit["singular_values"][-1], 0)
            for parameter in fit["parameters"]:
                self.assertLessEqual(parameter["low"], parameter["value"] * (1 + 1e-12))
                self.assertGreaterEqual(parameter["high"], parameter["value"] * (1 - 1e-12))
        self.check_evidence(study)
        report = pathlib.Path(study["report"]).read_text(encoding="utf-8")
        for outside in ("src=\"http", "href=\"http", "@import", "<script src"):
            self.assertNotIn(outside, report)
        self.assertEqual(report.count("<svg"), 12)
        self.assertEqual(report.count("data:image/png;base64"), 5)
        self.assertEqual([f for f in self.written() if f.endswith(".tmp")], [])
        self.check_recordings({run_["name"]: run_ for run_ in study["recordings"]})

    def check_ensemble(self, run):
        """Quantiles in order, and the percentile of the published number on their side of it."""
        ensemble = run["ensemble"]
        self.assertEqual((ensemble["seeds"], ensemble["unstable"]), (100, 0))
        for row in ("max_deg", "mean_deg"):
            for joint in ("joint1", "joint2"):
                p10, median, p90, percentile = (ensemble[key][row][joint] for key in (
                    "p10_deg", "median_deg", "p90_deg", "percentile_of_published"))
                self.assertTrue(0 < p10 < median < p90 < 180, (row, joint))
                published = run["paper"][row][joint]
                for share, quantile in ((10, p10), (50, median), (90, p90)):
                    self.assertEqual(percentile > share, published > quantile, (row, joint, share))

    def check_evidence(self, study):
        """Each fit of a row beside the statements on it; its misfits are those of its own four numbers."""
        published = {"E3": ((16.6, 23.5, 8.6, 5.2), (0.05,) * 4), "E4": ((3.4, 6.0, 0.3, 0.6), (0.05,) * 4),
                     "E4-text": ((3.4, 4.0, 0.34, 0.6), (0.05, 0.05, 0.005, 0.05))}
        stored = json.loads((ASSETS / "study/identification.json").read_text())["entries"]
        for row, (paper, half_digits) in published.items():
            found = [[fit["numbers"][f"{kind}{joint}_deg"] for kind in ("max", "mean") for joint in (1, 2)]
                     for fit in stored if fit["row"] == row]
            readings = [e for e in study["evidence"] if e["row"] == row]
            used = [e for e in readings if e["used"]]
            self.assertEqual(len(used), row != "E4-text")
            self.assertGreaterEqual(len(readings), 7)
            if used:
                run_ = study["runs"][row]
                found.append([*run_["max_deg"].values(), *run_["mean_deg"].values()])
            misfits = [[abs(x - p) / half for x, p, half in zip(numbers, paper, half_digits)] for numbers in found]
            for reading in readings:
                self.assertTrue(0 <= reading["automatic"]["share"] <= 1 and 0 <= reading["user"]["share"] <= 1)
                self.assertIn(reading["user_numbers_inside"], range(5))
                if reading["used"]:  # some of the operators of the ensemble
                    ensemble = study["runs"]["E1" if row == "E3" else "E2"]["ensemble"]["percentile_of_published"]
                    inside = sum(10 <= p <= 90 for kind in ("max_deg", "mean_deg") for p in ensemble[kind].values())
                    self.assertLessEqual(abs(reading["user_numbers_inside"] - inside), 1)
                nearest = min(misfits, key=lambda m: sum(abs(a - b) for a, b in zip(m, reading["misfit"])))
                for misfit, expected in zip(reading["misfit"], nearest):
                    self.assertAlmostEqual(misfit, expected, delta=1e-6 * max(1, expected), msg=reading)

    def check_recordings(self, made):
        """Scenes that run the study's own laws, and what the other commands make of them."""
        self.assertEqual(list(made), ["E1", "E2", "E3", "E4", "obstacle_linear", "obstacle_torsional",
                                      "obstacle_far"])
        for run_ in made.values():  # two programs' ways to the same numbers
            self.assertLess(run_["apart_deg"], 1e-9, run_["name"])
            self.twinarm("replay", run_["recording"])
            if run_["page"]:
                self.assertLess(pathlib.Path(run_["page"]).stat().st_size, 5e6)
        checks = self.json_of("inspect", made["E3"]["recording"], "--at", 1)
        self.assertTrue(all(check["pass"] for check in checks["checks"]))
        sources = {w["source"] for body in checks["balance"] for w in body["wrenches"]}
        self.assertIn("coupling/pull_joint1", sources)
        picture = self.folder / "both.png"
        self.twinarm("render", made["E3"]["recording"], "--side-by-side", made["E4"]["recording"], "--png", picture,
                     "--plot", "tracking-error", "--size", "320x200")
        self.assertTrue(picture.exists())

    # Help

    def test_options_are_described_within_the_columns_of_the_terminal(self):
        for command in self.commands():
            for width in (60, 80):
                text = run(command, "--help", env=dict(os.environ, COLUMNS=str(width))).stdout
                options = text[text.index("Options:"):].splitlines()
                self.assertLessEqual(max(map(len, options)), width, command)
                self.assertEqual(text.split(), run(command, "--help").stdout.split())

    # Bad names

    def commands(self):
        lines = run("--help").stdout.split("Subcommands:")[1].splitlines()
        return [line.split()[0] for line in lines if line.startswith("  ") and line[2] != " "]

    def test_an_empty_name_of_a_file_is_refused_whichever_option_it_is_given_to(self):
        files = ("out", "trace", "assets", "state", "html", "png", "frames", "mp4", "gif", "beside",
                 "svg", "csv", "work", "merge", "record", "post-mortem")
        tried = 0
        for command in self.commands():
            text = run(command, "--help").stdout
            given = [f"--{name}" for name in files if re.search(rf"--{name} +PATH\b", text)]  # not a flag of that name
            tried += len(given)
            for option in given:
                self.refused(run(command, option, ""), option, "the name of a file is empty")
                self.refused(run(command, f"{option}=", "A1"), f"'{option}='")
        self.assertGreater(tried, 20)
        for command in ("dynamics", "export", "map", "make-robot", "replay", "simulate"):
            self.refused(run(command, ""), "the name of a file is empty")
        self.refused(run("export", "a", ""), "page: the name of a file is empty")
        self.refused(run("replay", "a", "--plot", ""), "--plot: the name of a file is empty")

    # Bad files

    def study(self, *arguments):
        return run("study", "--out", self.folder / "out", *arguments)

    def test_all_columns_that_a_trace_lacks_are_named(self):
        file = self.write("hand.csv", "t[s],theta1[rad],theta3[deg],theta4\n0,0,0,0\n1,0,0,0\n")
        self.refused(self.study("--trace", file), "hand.csv:1", "theta2[rad]", "theta4[rad]",
                     "theta5[rad]", "theta6[rad]")

    def test_all_bad_lines_of_a_trace_are_named_with_their_numbers(self):
        file = self.write("hand.csv", HAND_COLUMNS + "0,0,0,0,0,0,0\n0.1,0,nan,0,0,0,0\n0.2,0,0,0,0,0,0\n"
                          "0.15,0,0,0,0,0,0\n0.3,0,0,0,text,0,0\n0.4,0,0,0,0,0,0\n")
        result = self.study("--trace", file)
        self.refused(result, "hand.csv:3", "nan", "hand.csv:5", "0.15", "hand.csv:6", "text")
        for line in (2, 4, 7):
            self.assertNotIn(f"hand.csv:{line}:", result.stderr)
        self.assertEqual(self.written(), ["hand.csv"])

    def test_errors_come_as_one_json_object_when_json_is_asked_for(self):
        file = self.write("hand.csv", HAND_COLUMNS + "0,0,0,0,0,0,0\n1,x,0,0,0,0,0\n1.5,0,y,0,0,0,0\n")
        result = self.study("--json", "--trace", file)
        self.refused(result, "hand.csv:3", "hand.csv:4")
        errors = json.loads(result.stdout)["errors"]
        self.assertEqual([error["line"] for error in errors], [3, 4])
        for error in errors:
            self.assertEqual(sorted(error), ["code", "file", "fix", "line", "problem", "where"])
            self.assertEqual(error["file"], str(file))
            self.assertTrue(error["problem"])

    def test_a_folder_that_cannot_be_written_is_named_before_any_work_is_done(self):
        file = self.folder / "taken"
        file.write_text("a file")
        before = processor_time_of_ended()
        self.refused(run("study", "--out", file / "study"), str(file))
        self.assertLess(processor_time_of_ended() - before, 5)
        self.assertEqual(file.read_text(), "a file")
        self.assertEqual(self.written(), ["taken"])

    def test_two_faults_of_a_robot_are_reported_at_once_with_their_lines(self):
        assets = self.copy_of_assets()
        urdf = assets / "robots" / "s103" / "s103.urdf"
        lines = urdf.read_text().splitlines(keepends=True)
        mass = next(n for n, line in enumerate(lines) if '<link name="arm1">' in line)
        mass = next(n for n in range(mass, len(lines)) if "<mass" in lines[n])
        lines[mass] = '      <mass value="-5"/>\n'
        joint = next(n for n, line in enumerate(lines) if '<joint name="joint2"' in line)
        axis = next(n for n in range(joint, len(lines)) if "<axis" in lines[n])
        lines[axis] = '    <axis xyz="0 0 none"/>\n'
        urdf.write_text("".join(lines))
        result = self.study("--json", "--assets", assets)
        self.refused(result, f"s103.urdf:{mass + 1}", f"s103.urdf:{axis + 1}")
        errors = json.loads(result.stdout)["errors"]
        self.assertEqual(sorted(error["line"] for error in errors), [mass + 1, axis + 1])
        self.assertFalse(any("out/" in name for name in self.written()))

    # Traces

    def test_a_trace_is_written_whole_the_same_for_the_same_seed_and_another_for_another(self):
        files = [self.folder / name for name in ("a.csv", "b.csv", "c.csv")]
        for file, seed in zip(files, (5, 5, 6)):
            self.twinarm("trace", "--seed", seed, "--duration", 2, "--rate", 50, "--out", file)
        a, b, c = (file.read_text() for file in files)
        self.assertEqual(a, b)
        self.assertNotEqual(a, c)
        self.assertEqual(len([line for line in a.splitlines() if line[0].isdigit()]), 101)
        self.assertEqual(self.written(), ["a.csv", "b.csv", "c.csv"])

    # Ctrl-C

    def interrupted_study(self, *words, after):
        """By Ctrl-C after so many seconds of processor time; it takes at most ten more to end."""
        before, used = processor_time_of_ended(), 0

        def is_ready(process):
            nonlocal used
            used = processor_time(process)
            return used > after
        _, err = self.interrupted("study", "--out", self.folder / "out", *words, is_ready=is_ready)
        self.assertLess(processor_time_of_ended() - before - used, 10)
        self.assertIn("interrupted", err)
        self.assertEqual([name for name in self.written() if name.endswith(".tmp")], [])

    def test_ctrl_c_in_a_study_ends_with_130_and_leaves_no_half_written_file(self):
        self.interrupted_study(after=0.7)
        self.interrupted_study(after=2.0)

    def test_ctrl_c_in_a_calibration_ends_with_130_and_leaves_the_old_one_as_it_was(self):
        assets = self.copy_of_assets()
        calibration = assets / "study" / "calibration.json"
        before = calibration.read_bytes()
        self.interrupted_study("--recalibrate", "--assets", assets, after=1.5)
        self.assertEqual(calibration.read_bytes(), before)


if __name__ == "__main__":
    main()
