"""`twinarm compare`: what it runs, what it tells, how it ends."""
import html
import html.parser
import json
import os
import pathlib
import re
import tempfile
import unittest

import program
from program import ROOT, ProgramTest, main


def run(*arguments, **more):
    return program.run("compare", *arguments, **more)


class Compare(ProgramTest):
    def answer(self, *arguments):
        result = run(*arguments, "--json")
        self.assertEqual(result.stderr, "")
        answer = json.loads(result.stdout)
        self.assertEqual(result.returncode, 1 if answer["failed"] else 0)
        self.assertEqual(answer["passed"] + answer["failed"], len(answer["cases"]))
        self.assertEqual(sum(c["pass"] for c in answer["cases"]), answer["passed"])
        return answer

    def test_a_case_has_all_its_keys_and_passes_where_its_error_is_within_the_tolerance(self):
        answer = self.answer("D7", "E6-momentum", "E2-creep")
        self.assertEqual([c["name"] for c in answer["cases"]], ["D7", "E6-momentum", "E2-creep"])
        self.assertEqual(list(answer), ["schema", "cases", "passed", "failed", "skipped"])
        for case in answer["cases"]:
            self.assertEqual(list(case), ["name", "group", "error", "tolerance", "pass", "order",
                                          "energy_drift", "reference", "seconds"])
            self.assertEqual(case["pass"], case["error"] <= case["tolerance"])
            self.assertGreaterEqual(case["seconds"], 0)
        self.assertEqual(answer["skipped"], [])

    def test_a_short_name_means_all_that_it_begins(self):
        names = [c["name"] for c in self.answer("E6")["cases"]]
        self.assertIn("E6-two", names)
        self.assertTrue(all(name.startswith("E6-") for name in names), names)

    def test_a_group_and_names_add_up_and_conserved_energy_is_reported(self):
        asked = ["D3", "D4", "D5-springs", "D5-rods", "E6-two"]
        answer = self.answer(*asked, "--group", "robots")
        self.assertEqual([c["name"] for c in answer["cases"] if c["group"] != "robots"],
                         asked[:4] + ["D3-rates", "D4-velocity"] + asked[4:])
        self.assertGreater(len(answer["cases"]), len(asked) + 4)
        loops = {c["name"]: c for c in answer["cases"]}
        self.assertLess(loops["D4"]["energy_drift"], 1e-8)
        self.assertLess(loops["D3"]["energy_drift"], 1e-8)  # the motor's work counted
        self.assertIsNone(loops["D5-springs"]["energy_drift"])  # dampers take it
        self.assertAlmostEqual(loops["D5-rods"]["order"], 4, delta=0.1)

    def test_people_get_a_table_with_a_row_for_each_and_the_sums(self):
        result = run("E6-two", "D7")
        rows = result.stdout.splitlines()
        self.assertEqual(rows[0].split(), ["case", "error", "tolerance", "order", "energy", "seconds"])
        self.assertEqual([row.split()[0] for row in rows[1:3]], ["D7", "E6-two"])
        self.assertEqual([row.split()[3] for row in rows[1:3]], ["pass", "pass"])
        self.assertEqual(rows[-1], "2 passed, 0 failed")
        self.assertEqual((result.returncode, result.stderr), (0, "twinarm: cases: 2, about 1 s\n"))

    def test_a_letter_and_the_name_of_a_group_stand_for_all_of_it(self):
        by_letter = self.answer("A")
        self.assertEqual({c["group"] for c in by_letter["cases"]}, {"free-body"})
        self.assertEqual([c["name"] for c in by_letter["cases"]],
                         [c["name"] for c in self.answer("free-body")["cases"]])
        self.assertTrue(all(c["pass"] for c in by_letter["cases"]))

    def test_a_known_motion_has_its_order_and_other_integrators_stand_beside(self):
        answer = self.answer("A2", "B9-free", "D7", "--integrator", "verlet,dopri5", "--step", "0.002,0.001")
        rows = {c["name"]: c for c in answer["cases"]}
        self.assertAlmostEqual(rows["A2"]["order"], 4, delta=0.1)
        self.assertLess(rows["A2"]["energy_drift"], 1e-12)
        self.assertIsNone(rows["B9-free"]["order"])  # exact but for rounding
        self.assertEqual(rows["D7"]["configurations"], [])
        lanes = rows["A2"]["configurations"]
        self.assertEqual([(lane["integrator"], lane["step"], lane["tolerance"]) for lane in lanes],
                         [("verlet", 0.002, None), ("verlet", 0.001, None), ("dopri5", None, 1e-10)])
        self.assertAlmostEqual(lanes[0]["error"] / lanes[1]["error"], 4, delta=0.1)
        self.assertAlmostEqual(lanes[0]["order"], 2, delta=0.1)
        table = run("A2", "D7", "--integrator", "verlet", "--step", "0.002").stdout.splitlines()
        self.assertIn("verlet 0.002", table[0])
        self.assertEqual([row.split()[-1] for row in table if row.startswith("D7")], ["-"])

    def test_the_outcome_of_a_case_does_not_depend_on_what_runs_beside_it(self):
        together = {c["name"]: c for c in self.answer("A", "B2", "D7")["cases"]}
        for name in ("A1", "A5-momentum", "B2-over"):
            alone = self.answer(name)["cases"][0]
            del alone["seconds"]
            self.assertEqual(alone, {k: together[name][k] for k in alone})

    def test_what_is_not_run_is_listed_with_the_reason_and_never_counted(self):
        answer = self.answer("F5", "D7")
        self.assertEqual([c["name"] for c in answer["cases"]], ["D7"])
        self.assertEqual([c["name"] for c in answer["skipped"]], ["F5"])
        self.assertGreater(len(answer["skipped"][0]["why"]), 10)
        self.assertEqual(run("F5", "D7").stdout.splitlines()[-1], "1 passed, 0 failed, 1 skipped")

    def test_whatever_has_no_data_or_no_model_is_skipped_and_nothing_is_passed_for_it(self):
        names = ["D8", "E14-capstan", "E15", "F5", "H1-anymal", "H2", "H3"]
        answer = self.answer(*names)
        self.assertEqual([c["name"] for c in answer["skipped"]], names)
        self.assertEqual((answer["cases"], answer["passed"], answer["failed"]), ([], 0, 0))

    def test_robots_and_couplings_are_group_f(self):
        answer = self.answer("F1", "F2", "F3-joint", "F4-euler")
        rows = {c["name"]: c for c in answer["cases"]}
        self.assertEqual({c["group"] for c in answer["cases"]}, {"robots", "couplings"})
        self.assertTrue(all(c["pass"] for c in answer["cases"]), answer["cases"])
        self.assertTrue({"F1-published", "F2-velocity", "F3-joint-mean", "F4-euler-difference"} <= set(rows))
        self.assertAlmostEqual(rows["F3-joint"]["order"], 4, delta=0.2)

    def test_ctrl_c_ends_it_with_130_no_half_answer_and_no_page(self):
        out, err = self.interrupted("compare", "--json")
        self.assertEqual(out, "")
        self.assertIn("interrupted", err)
        self.interrupted("compare", "--html", self.folder / "out")
        self.assertEqual(list(self.folder.iterdir()), [])


class Tags(html.parser.HTMLParser):
    """The page as a list of (tag, attributes), and whether all that must be closed is."""
    OPEN = {"meta", "th", "td", "tr", "br", "path", "use", "circle", "rect"}  # need no end

    def __init__(self, text):
        super().__init__()
        self.all, self.open, self.wrong = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.all.append((tag, dict(attributes)))
        if tag not in self.OPEN:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.all.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        if tag in self.OPEN:
            return
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)


class Drawing:
    """The circles and lines of the first figure of a section, in pixels."""
    LEGEND = 725  # from here on to the right

    @staticmethod
    def of(section):
        svg = re.search(r"<svg.*?</svg>", section, re.S).group(0)
        circles = [(float(x), float(y)) for x, y in re.findall(
            r"_gpPt5' transform='translate\(([-0-9.]+),([-0-9.]+)\)", svg)]
        lines = []
        for colour, d in re.findall(r"<path stroke='([^']*)'[^>]*? d='([^']+)'", svg):
            if colour in ("rgb(228, 228, 228)", "rgb( 85,  85,  85)"):  # of the grid, of the axes
                continue
            for part in re.findall(r"M([^M]+)", d):
                lines.append([(float(x), float(y)) for x, y in re.findall(r"([-0-9.]+),([-0-9.]+)", part)])
        return [c for c in circles if c[0] < Drawing.LEGEND], lines

    @staticmethod
    def distance(point, lines):
        def to(a, b):
            dx, dy = b[0] - a[0], b[1] - a[1]
            length = dx * dx + dy * dy
            along = ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / length if length else 0
            along = min(max(along, 0), 1)
            return ((a[0] + along * dx - point[0]) ** 2 + (a[1] + along * dy - point[1]) ** 2) ** .5
        return min(to(a, b) for line in lines for a, b in zip(line, line[1:]))


class Page(unittest.TestCase):
    """One page of cases of every kind, made once."""
    NAMES = ["A1", "A3", "A5-ballistic", "B1-45", "B3-start", "C3-2", "D1-hinge", "D7", "E1-times",
             "E2-slide", "E2-place", "E2-threshold", "E6-two", "E7-sign", "G1-rk4", "G4-rk4", "F5"]

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = pathlib.Path(cls.folder.name) / "not" / "yet"
        cls.result = run(*cls.NAMES, "--html", cls.out, "--json")
        cls.answer = json.loads(cls.result.stdout)
        cls.page = (cls.out / "compare.html").read_text(encoding="utf-8")
        cls.tags = Tags(cls.page)
        parts = re.split(r'<section class=case id="([^"]+)">', cls.page)
        cls.sections = dict(zip(parts[1::2], parts[2::2]))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_it_is_one_file_that_the_answer_names(self):
        self.assertEqual(self.result.returncode, 0)
        self.assertEqual(self.answer["page"], str(self.out / "compare.html"))
        self.assertEqual([p.name for p in self.out.iterdir()], ["compare.html"])

    def test_it_needs_nothing_from_outside(self):
        for tag, attributes in self.tags.all:
            self.assertNotIn(tag, ("script", "link", "iframe", "object", "embed", "base"))
            for key in ("src", "href", "xlink:href", "data"):
                value = attributes.get(key) or "#"
                self.assertTrue(value.startswith(("#", "data:")), (tag, key, value))
        self.assertIsNone(re.search(r"@import|url\((?!['\"]?#)", self.page))

    def test_what_is_opened_is_closed_and_every_link_and_mark_has_its_one_target(self):
        self.assertEqual((self.tags.wrong, self.tags.open), ([], []))
        ids = [a["id"] for _, a in self.tags.all if "id" in a]
        self.assertEqual(len(ids), len(set(ids)))
        for _, attributes in self.tags.all:
            for key in ("href", "xlink:href"):
                if key in attributes:
                    self.assertIn(attributes[key][1:], ids)

    def test_every_case_has_its_row_and_its_section_with_formula_and_code(self):
        names = [c["name"] for c in self.answer["cases"]]
        self.assertLess(set(self.NAMES) - {"F5"}, set(names))  # A1-start and others too
        self.assertEqual(re.findall(r'<tr data-case="([^"]+)">', self.page), names)
        self.assertEqual(list(self.sections), names)
        for name, section in self.sections.items():
            self.assertIn("<p class=formula>", section, name)
            self.assertIn(f"twinarm compare {name}", section)
            place = re.search(r'<a href="#(code-\S+)">\S+</a>, line (\d+)', section)
            code = re.search(rf'<summary id="{place[1]}">.*?<pre>(.*?)</pre></details>', self.page,
                             re.S).group(1).splitlines()
            line = html.unescape(code[int(place[2]) - 1])
            self.assertTrue([quoted for quoted in re.findall(r'"([^"]+)"', line)
                             if name.startswith(quoted)], (name, line))

    def test_the_numbers_of_the_index_are_those_of_json_to_the_last_digit(self):
        for case in self.answer["cases"]:
            row = re.search(rf'<tr data-case="{case["name"]}">(.*?)</tr>', self.page, re.S).group(1)
            numbers = [float(x) for x in re.findall(r'data-value="([^"]+)"', row)]
            wanted = [case[k] for k in ("error", "tolerance", "order", "energy_drift", "seconds")]
            self.assertEqual(numbers, [x for x in wanted if x is not None], case["name"])
            self.assertIn(">pass<" if case["pass"] else ">fail<", row)

    def test_what_is_skipped_is_in_the_index_with_its_reason(self):
        row = re.search(r'<tr data-skipped="F5">(.*?)</tr>', self.page, re.S).group(1)
        self.assertIn(self.answer["skipped"][0]["why"], row)

    def test_a_motion_is_drawn_with_its_errors_and_energy_and_a_state_has_its_readings(self):
        for name, figures in {"A1": 3, "B1-45": 3, "G1-rk4": 2, "A5-ballistic": 2, "D1-hinge": 3}.items():
            self.assertEqual(self.sections[name].count("<svg"), figures, name)
        for scheme in ("euler", "verlet", "rk4", "dopri5", "trapezoid"):
            self.assertIn(scheme, self.sections["A1"])
        self.assertIn("step [s]", self.sections["A1"])
        self.assertIn("time [s]", self.sections["A1"])
        self.assertIn("14.715", self.sections["B3-start"])
        for name in ("B3-start", "E7-sign", "D7"):
            self.assertNotIn("<svg", self.sections[name])

    def test_a_contact_case_is_drawn_with_its_energy_and_its_error_or_why_it_has_none(self):
        for name, figures in {"E1-times": 2, "E2-slide": 3, "E2-place": 3, "E2-threshold": 2, "E6-two": 3}.items():
            self.assertEqual(self.sections[name].count("<svg"), figures, name)
        self.assertIn("does not depend on the step", self.sections["E1-times"])
        self.assertIn("bisection", self.sections["E2-threshold"])
        for words in ("height of the ball", "[m]", "exact", "time [s]", "E − E₀"):
            self.assertIn(words, self.sections["E1-times"])
        # The middle of 0.4 and 0.8 holds, that of 0.4 and 0.6 does not.
        for tried in ("μ = 0.6", "μ = 0.5"):
            self.assertIn(tried, self.sections["E2-threshold"])
        order = next(c["order"] for c in self.answer["cases"] if c["name"] == "E2-place")
        text = re.sub(r"<[^>]+>", " ", self.sections["E2-place"])
        slope = float(re.search(r"semi-implicit\s+([0-9.]+)", text).group(1))
        self.assertAlmostEqual(slope, order, delta=0.01)

    def test_every_contact_case_is_drawn_but_the_one_where_nothing_moves(self):
        cases = "".join(p.read_text() for p in ROOT.glob("benchmarks/analytic/contact/*.cpp"))
        drawn = {}
        for call in cases.split("contact_case<")[1:]:
            name, after = re.search(r'^[^>]+>\(\s*"([^"]+)",\s*[^,)]+([,)])', call).groups()
            drawn[name] = after == ","
        self.assertGreater(len(drawn), 50)
        self.assertEqual([name for name in drawn if not drawn[name]], ["E7-sign"])
        tasks = re.findall(r'task_case\(\s*"(H1[^"]+)"', cases)  # with what is drawn of them
        self.assertEqual(len(tasks), 5)

    def test_the_circles_of_the_reference_lie_on_the_lines_of_the_run(self):
        for name, circles in {"A1": 7 * 25, "A3": 7 * 25, "B1-45": 3, "D1-hinge": 3 * 25,
                              "E1-times": 25, "E2-place": 25, "E2-slide": 25, "E6-two": 50}.items():
            drawn, lines = Drawing.of(self.sections[name])
            self.assertEqual(len(drawn), circles, name)
            for circle in drawn:
                self.assertLess(Drawing.distance(circle, lines), 2.0, (name, circle))

    def test_the_slopes_beside_the_schemes_are_their_orders(self):
        text = re.sub(r"<[^>]+>", " ", self.sections["B1-45"])
        for scheme, order in {"rk4": 4, "verlet": 2, "euler": 1, "heun": 2}.items():
            slope = re.search(rf"\b{scheme}\s+([0-9.]+)", text).group(1)
            self.assertAlmostEqual(float(slope), order, delta=0.15, msg=scheme)


class Guide(unittest.TestCase):
    def test_the_guide_shows_the_example_that_is_compiled(self):
        guide = (ROOT / "docs/develop/adding_a_case.md").read_text(encoding="utf-8")
        example = (ROOT / "tests/benchmarks/analytic/registry/example_case.cpp").read_text(encoding="utf-8")
        named = re.findall(r"\(`(hanging_\w+)`\)", guide)
        self.assertEqual(len(named), 4)
        for words in named + re.findall(r"^:(?:start-at|end-before): (.*)$", guide, re.M):
            self.assertIn(words, example)


class PageFaults(unittest.TestCase):
    def test_without_gnuplot_the_remedy_is_to_install_it(self):
        with tempfile.TemporaryDirectory() as folder:
            result = run("D7", "--html", folder, env={**os.environ, "PATH": folder})
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn("install gnuplot-nox", result.stderr)
            self.assertEqual(os.listdir(folder), [])

    def test_a_file_name_may_be_given_in_place_of_a_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            result = run("D7", "--html", folder + "/mine.html")
            self.assertEqual(os.listdir(folder), ["mine.html"])
        self.assertEqual(result.stdout.splitlines()[-1], f"wrote {folder}/mine.html")


if __name__ == "__main__":
    main()
