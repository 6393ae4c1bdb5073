"""Page of `inspect --html`: JSON of `inspect --json`, and steps through the passes.

    test_inspect_page.py PATH/TO/twinarm [FOLDER_FOR_PICTURES]
"""
import json
import pathlib
import tempfile
import unittest

from browser import NO_BROWSER, find_browser
from page_file import PageTest, data_of, main, page_browser, setUpModule  # noqa: F401
from program import ROOT, twinarm

ROBOT = ROOT / "assets" / "robots" / "s103" / "s103.urdf"
STATE = {"q": {"joint1": 0.6, "joint2": -0.8}, "qd": {"joint1": 1.0, "joint2": -2.0}, "tau": {"joint1": 1.5}}


class InspectPage(PageTest):
    @classmethod
    def setUpClass(cls):
        folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        state = folder / "state.json"
        state.write_text(json.dumps(STATE), encoding="utf-8")
        cls.file = folder / "page.html"
        done = twinarm("inspect", ROBOT, "--state", state, "--json", "--html", cls.file)
        cls.exported = json.loads(done.stdout)
        cls.html = cls.file.read_text(encoding="utf-8")
        cls.page = data_of(cls.html)

    def test_data_equals_the_json_output(self):
        self.assertEqual(json.loads(self.page["inspection"]), self.exported)

    def test_each_body_has_a_layer(self):
        def entries(layer):
            return len(layer["instances"]["mesh"])
        apart = {layer["name"]: entries(layer) for layer in self.page["layers"] if layer["name"].startswith("body/")}
        bodies = {step["body"] for step in self.exported["passes"]}
        self.assertEqual(set(apart), {f"body/{name}" for name in bodies} | {"body/world"})
        whole = next(layer for layer in self.page["layers"] if layer["name"] == "bodies")
        self.assertEqual(sum(apart.values()), entries(whole))
        self.assertGreater(apart["body/arm2"], 0)

    def test_no_requests_and_small(self):
        self.assertIn("default-src 'none'", self.html)
        self.assertLess(len(self.html), 5e6)

    @unittest.skipUnless(find_browser(), NO_BROWSER)
    def test_keys_step_through_the_passes(self):
        with page_browser() as browser:
            browser.open(self.file.as_uri())
            steps = self.exported["passes"]
            wanted = [(step["pass"], step["body"]) for step in steps]
            walked = []
            for _ in steps:
                state = browser.evaluate("window.twinarm.page.state")
                walked.append((state["pass"], state["body"]))
                self.check_numbers(browser, steps[state["step"] - 1])
                browser.press("ArrowRight")
            self.assertEqual(walked, wanted)
            browser.press("2")
            browser.press("ArrowRight")
            browser.press("ArrowLeft")
            state = browser.evaluate("window.twinarm.page.state")
            self.assertEqual((state["pass"], state["body"]), (2, "gripper"))
            for number, (step, theme) in enumerate(((3, "light"), (8, "dark"), (13, "light"))):
                if self.pictures:
                    browser.open(f"{self.file.as_uri()}#step={step}&theme={theme}")
                    self.picture(browser, f"inspect_{number}")
            self.assertEqual(browser.errors, [])

    def check_numbers(self, browser, step):
        """Tooltips have all digits."""
        shown = browser.evaluate(
            "Object.fromEntries([...document.querySelectorAll('[data-quantity]')].map(card => "
            "[card.dataset.quantity, [...card.querySelectorAll('[title]')].map(e => e.title)]))")
        for quantity in step["quantities"]:
            value = quantity["value"]
            numbers = [value] if not isinstance(value, list) else [
                n for row in value for n in (row if isinstance(row, list) else [row])]
            self.assertEqual([float(text) for text in shown[quantity["name"]]], numbers)


if __name__ == "__main__":
    main()
