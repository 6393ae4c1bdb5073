"""The inspector alone in a browser: numbers, equations, diagram, walk through a call.

    test_inspector_panel.py FOLDER_OF_NODE_MODULES [FOLDER_FOR_PICTURES]
"""
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from browser import NO_BROWSER, Browser, find_browser
from waiting import TIMEOUT

HERE = pathlib.Path(__file__).resolve().parent
MODULES = pathlib.Path(sys.argv.pop(1)).resolve()
PICTURES = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else None
# Of the arm in hand_and_obstacles.toml in contact with a box, written by the program.
MESSAGE = json.loads((HERE / "inspector_message.json").read_text(encoding="utf-8"))
NODE = shutil.which("node") or shutil.which("nodejs")

BUNDLE = """
const [modules, entry] = process.argv.slice(1);
const esbuild = require(modules + '/esbuild');
esbuild.build({entryPoints: [entry], nodePaths: [modules], bundle: true, write: false,
  outfile: 'out.js', format: 'iife', target: 'es2021'}).then((built) => {
  const text = (end) => built.outputFiles.find((file) => file.path.endsWith(end)).text;
  process.stdout.write(JSON.stringify([text('.js'), text('.css')]));
});
"""
STYLE = "body.harness{display:block;height:auto;padding:12px;background:var(--surface)}"


def flat(value):
    """All numbers of a quantity, in their order."""
    if isinstance(value, list):
        return [number for item in value for number in flat(item)]
    return [value]


@unittest.skipUnless(find_browser(), NO_BROWSER)
@unittest.skipUnless(NODE and (MODULES / "esbuild").is_dir(),
                     "the program was built without its pages: scripts/setup --web, then build")
class InspectorPanel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = subprocess.run([NODE, "-e", BUNDLE, str(MODULES), str(HERE / "inspector_harness.ts")],
                              capture_output=True, text=True, check=True, timeout=TIMEOUT)
        script, style = json.loads(done.stdout)
        cls.folder = tempfile.TemporaryDirectory()
        cls.page = pathlib.Path(cls.folder.name) / "inspector.html"
        cls.names = ["world"] + [row["body"] for row in MESSAGE["rows"] if row["pass"] == 1]
        cls.page.write_text(
            f'<!doctype html><html data-theme="light" data-bodies="{",".join(cls.names)}"><meta charset="utf-8">'
            f"<style>{style}{STYLE}</style><body><script>"
            + script.replace("</script", "<\\/script") + "</script></body></html>", encoding="utf-8")
        cls.browser = Browser(420, 900)
        cls.browser.__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.folder.cleanup()

    def setUp(self):
        self.browser.open(self.page.as_uri())
        self.browser.wait_for("inspector.sent.length > 0")

    def tearDown(self):
        self.assertEqual(self.browser.errors, [])

    def give(self, message):
        self.browser.evaluate(f"inspector.give({json.dumps(message)})")

    def go_to(self, pass_, body):
        """Clicks on the pass and on the body."""
        self.browser.evaluate(f"document.querySelectorAll('.stepper .pass')[{pass_ - 1}].click()")
        self.browser.evaluate("[...document.querySelectorAll('.stepper .current button')].find("
                              f"b => b.textContent === {json.dumps(body)}).click()")

    def test_requests_the_first_body_of_the_robot_and_follows_the_selection(self):
        self.assertEqual(self.browser.evaluate("inspector.sent.at(-1)"), {"do": "inspect", "on": True, "body": 2})
        self.browser.evaluate("inspector.panel.onSelect(3)")
        self.assertEqual(self.browser.evaluate("inspector.sent.at(-1)"), {"do": "inspect", "on": True, "body": 3})

    def test_keys_step_through_one_call(self):
        links = self.names[1:]
        wanted = [(p, b) for p in (1, 2, 3) for b in (links[::-1] if p == 2 else links)]
        self.go_to(1, links[0])
        walked = []
        for _ in wanted:
            state = self.browser.evaluate("inspector.panel.state")
            walked.append((state["pass"], state["body"]))
            self.browser.press(".")
        self.assertEqual(walked, wanted)
        self.browser.press(",")
        state = self.browser.evaluate("inspector.panel.state")
        self.assertEqual((state["pass"], state["body"]), wanted[-2])

    def test_cards_have_all_digits_of_each_quantity(self):
        for step in MESSAGE["passes"]:
            self.go_to(step["pass"], MESSAGE["name"])
            self.give(MESSAGE)
            shown = self.browser.evaluate(
                "Object.fromEntries([...document.querySelectorAll('.cards > [data-quantity]')].map("
                "card => [card.dataset.quantity, [...card.querySelectorAll('[title]')].map(e => e.title)]))")
            for quantity in step["quantities"]:
                digits = [float(text) for text in shown[quantity["name"]] if is_number(text)]
                for number in flat(quantity["value"]):
                    self.assertIn(number, digits, quantity["name"])

    def test_equations_and_their_terms(self):
        self.go_to(1, MESSAGE["name"])
        self.give(MESSAGE)
        self.assertGreater(self.browser.evaluate(
            "Math.min(...[...document.querySelectorAll('.set math')].map("
            "m => m.getBoundingClientRect().width))"), 60)
        v = next(e for e in MESSAGE["equations"] if e["name"] == "v")
        rows = self.browser.evaluate(
            "[...document.querySelectorAll('.cards > [data-quantity=v] tbody tr')].map("
            "row => [...row.querySelectorAll('.number')].map(cell => Number(cell.title)))")
        for k, row in enumerate(rows):
            self.assertEqual(row, [term["value"][k] for term in v["terms"]] + [v["value"][k]])
            self.assertAlmostEqual(sum(row[:-1]), row[-1], delta=1e-9)

    def test_table_of_pass_3_has_classical_accelerations_of_the_origins(self):
        self.go_to(3, self.names[-1])
        self.give({**MESSAGE, "name": self.names[-1]})  # the last step of the pass: all rows are known
        shown = self.browser.evaluate(
            "[...document.querySelectorAll('.pass-table tbody tr')].map("
            "row => [row.querySelector('button').textContent, row.querySelector('td:last-child').title])")
        rows = [row for row in MESSAGE["rows"] if row["pass"] == 3]
        self.assertEqual([name for name, _ in shown], [row["body"] for row in rows])
        for (name, length), row in zip(shown, rows):
            values = {q["name"]: q["value"] for q in row["quantities"]}
            self.assertAlmostEqual(float(length), math.hypot(*values["acceleration"]), delta=1e-12)
        heads = self.browser.evaluate("document.querySelector('.pass-table thead').textContent")
        self.assertIn("|acceleration| [m/s²]", heads)

    def test_polygons_of_the_diagram_close(self):
        self.give(MESSAGE)
        for plane in ("xz", "yz", "xy"):
            self.browser.evaluate(f"document.querySelector('[data-plane={plane}]').click()")
            for figure in (0, 1):
                dot, tip = self.browser.evaluate(
                    "(() => { const svg = document.querySelectorAll('.diagram svg')[%d];"
                    "const dot = svg.querySelector('circle');"
                    "const tips = [...svg.querySelectorAll('polygon')];"
                    "return [dot ? [+dot.getAttribute('cx'), +dot.getAttribute('cy')] : null,"
                    "tips.length ? tips.at(-1).getAttribute('points').split(' ')[0].split(',')"
                    ".map(Number) : null]; })()" % figure)
                if tip:
                    self.assertLess(math.dist(dot, tip), 2)  # of 200; the shortest are not drawn
        self.assertEqual(len(self.browser.evaluate("inspector.arrows")), len(MESSAGE["balance"][0]["wrenches"]))

    def test_tooltip_shows_on_focus_and_stays_while_numbers_change(self):
        self.go_to(3, MESSAGE["name"])
        self.give(MESSAGE)
        self.browser.evaluate("document.querySelector('.cards > [data-quantity=a]').focus({focusVisible: true})")
        for t in (1, 2):
            self.give({**MESSAGE, "t": t, "paused": False})
            tip = self.browser.evaluate(
                "(() => { const tip = document.querySelector('.cards > [data-quantity=a] .tip');"
                "return [getComputedStyle(tip).visibility, tip.textContent]; })()")
            self.assertEqual(tip[0], "visible")
            self.assertIn("rad/s²; m/s²", tip[1])
            self.assertIn("table 7.1", tip[1])
        self.assertEqual(self.browser.evaluate("inspector.arrows"), [])  # only while paused

    def test_values_that_are_not_finite(self):
        broken = json.loads(json.dumps(MESSAGE))
        for step in broken["passes"]:
            for quantity in step["quantities"]:
                quantity["value"] = nothing(quantity["value"])
        for equation in broken["equations"]:
            equation["residual"] = None
            for part in [equation, *equation["terms"]]:
                part["value"] = nothing(part["value"])
        for wrench in broken["balance"][0]["wrenches"]:
            wrench["force"] = wrench["torque"] = [None] * 3
        for pass_ in (1, 2, 3):
            self.go_to(pass_, MESSAGE["name"])
            self.give(broken)
        self.give({"kind": "inspection", "scene": 1, "t": 1, "paused": True, "warnings": ["cannot be inspected"]})
        self.assertIn("cannot be inspected", self.browser.evaluate("document.body.textContent"))

    def test_pictures(self):
        if not PICTURES:
            return  # for visual checks
        PICTURES.mkdir(parents=True, exist_ok=True)
        for width in (400, 1100):
            self.browser.resize(width, 1500)
            for pass_ in (1, 2, 3):
                for dark in (False, True):
                    self.browser.evaluate(f"inspector.theme({json.dumps(dark)})")
                    self.go_to(pass_, MESSAGE["name"])
                    self.give(MESSAGE)
                    self.browser.frames(2)
                    theme = "dark" if dark else "light"
                    self.browser.picture(PICTURES / f"inspector_{width}_{pass_}_{theme}.png")
        self.browser.resize(420, 900)


def is_number(text):
    try:
        float(text)
    except ValueError:
        return False
    return True


def nothing(value):
    return [nothing(item) for item in value] if isinstance(value, list) else None


if __name__ == "__main__":
    unittest.main()
