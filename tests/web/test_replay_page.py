"""Replay page: its data, and the page in a browser.

    test_replay_page.py PATH/TO/twinarm [FOLDER_FOR_PICTURES]
"""
import json
import pathlib
import tempfile
import unittest

from browser import NO_BROWSER, find_browser
from page_file import PageTest, data_of, main, page_browser, png, setUpModule  # noqa: F401
from program import SCENES, data, twinarm


# Texture of the flag of tests/data, seen along y.
RED, GREEN, BLUE = (230, 20, 20), (20, 200, 20), (20, 20, 230)
CLOTH = [[RED] * 4 + [GREEN] * 4] * 4 + [[BLUE] * 8] * 4


def write_flag(folder):
    for name in ("flag.obj", "flag.urdf"):
        (folder / name).write_text(data(name))
    (folder / "flag.mtl").write_text("newmtl cloth\nKd 1 1 1\nmap_Kd cloth.png\n")
    (folder / "cloth.png").write_bytes(png(CLOTH))
    return folder / "flag.urdf"


class Page:
    """A recording, its page, and the data of both."""

    def __init__(self, folder, scene, *options):
        self.recording = folder / f"{pathlib.Path(scene).stem}.twinrec"
        self.file = self.recording.with_suffix(".html")
        twinarm("simulate", scene, "--record", self.recording, "--json", *options)
        self.report = json.loads(twinarm("export", self.recording, self.file, "--json").stdout)
        self.html = self.file.read_text(encoding="utf-8")
        self.run = data_of(self.html)
        self.exported = json.loads(twinarm("export", self.recording, "--json").stdout)

    def channel(self, name):
        return next(c["values"] for c in self.run["channels"] if c["name"] == name)

    def layer(self, name):
        return next(layer for layer in self.run["layers"] if layer["name"] == name)

    def exported_frames(self):
        by_time = {frame["t"]: frame for frame in self.exported["frames"]}
        return [by_time[t] for t in self.run["times"]]


class Pages(PageTest):
    @classmethod
    def setUpClass(cls):
        folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.arm = Page(folder, SCENES / "robot_beside_obstacles.toml")
        cls.ball = Page(folder, SCENES / "bouncing_ball.toml", "--duration", 1)
        cls.flag = Page(folder, write_flag(folder), "--duration", 0.1)


class Contents(Pages):
    def test_channels_and_works_equal_the_recording(self):
        for page in (self.arm, self.ball):
            frames = page.exported_frames()
            for i, column in enumerate(page.exported["columns"]):
                self.assertEqual(page.channel(column["name"]), [f["values"][i] for f in frames])
            rows = page.run["energy_balance"]["rows"]
            works = page.run["energy_balance"]["works"]
            for n, frame in enumerate(frames):
                got = dict(zip(rows, works[n * len(rows):(n + 1) * len(rows)]))
                self.assertEqual({k: v for k, v in got.items() if v}, {
                    k: v for k, v in frame["energy_balance"].items() if v})
            end = dict(zip(rows, map(float, page.run["energy_balance"]["end"])))
            self.assertEqual(end, {row: frames[-1]["energy_balance"].get(row, 0) for row in rows})

    def test_first_and_last_recorded_frame(self):
        for page in (self.arm, self.ball):
            times = [frame["t"] for frame in page.exported["frames"]]
            self.assertEqual((page.run["times"][0], page.run["times"][-1]), (times[0], times[-1]))
            self.assertEqual(page.run["times"], sorted(set(page.run["times"])))

    def test_ball_is_drawn_at_its_position(self):
        layer = self.ball.layer("bodies")["instances"]
        names = [f"links/ball/{axis}" for axis in "xyz"]
        moved = [self.ball.channel(name) for name in names]
        for frame in range(len(self.ball.run["times"])):
            entries = range(layer["first"][frame], layer["first"][frame + 1])
            places = [layer["position"][3 * i:3 * i + 3] for i in entries]
            wanted = [values[frame] for values in moved]
            off = min(max(abs(a - b) for a, b in zip(p, wanted)) for p in places)
            self.assertLess(off, 1e-6)

    def test_tracking_error_is_actual_minus_target(self):
        errors = [c for c in self.arm.run["channels"] if c["kind"] == "error"]
        self.assertTrue(errors)
        for error in errors:
            of = error["of"]
            pairs = zip(self.arm.channel(f"q/{of}"), self.arm.channel(f"target/{of}"))
            self.assertEqual(error["values"], [a - b for a, b in pairs])

    def test_momentum_balance_equals_the_recording(self):
        for page in (self.arm, self.ball):
            rows, values = page.run["momentum"]["rows"], page.run["momentum"]["values"]
            self.assertTrue(rows)
            for n, frame in enumerate(page.exported_frames()):
                for i, row in enumerate(rows):
                    recorded = frame["momentum"].get(row, {"linear": [0] * 3, "angular": [0] * 3})
                    at = 6 * (n * len(rows) + i)
                    self.assertEqual(values[at:at + 6], recorded["linear"] + recorded["angular"])

    def test_command_and_settings(self):
        facts = dict(self.arm.run["facts"])
        self.assertEqual(facts["step"], "1 ms")
        self.assertEqual(facts["integrator"], self.arm.exported["integrator"])
        self.assertEqual(facts["seed"], str(self.arm.exported["seed"]))
        self.assertEqual(facts["twinarm"], self.arm.exported["program"])
        self.assertIn("simulate", self.arm.run["command"])
        files = {file["name"]: file["text"] for file in self.arm.run["files"]}
        scene = (SCENES / "robot_beside_obstacles.toml").read_text(encoding="utf-8")
        self.assertEqual(files["robot_beside_obstacles.toml"], scene)

    def test_no_requests_and_small(self):
        for page in (self.arm, self.ball):
            self.assertLess(page.report["bytes"], 5e6)
            self.assertEqual(page.report["bytes"], page.file.stat().st_size)
            self.assertIn("default-src 'none'", page.html)
            head = page.html[:page.html.index('id="run"')]
            self.assertNotRegex(head, r"""(src|href)\s*=\s*(?!"data:)|@import|url\(\s*['\"]?http""")

    def test_licences_of_libraries(self):
        for words in ("three.js authors", "Leon Sorokin", "Permission is hereby granted"):
            self.assertIn(words, self.arm.html)

    def test_all_wrong_options_are_reported(self):
        for place, word in (("page.txt", ".html"), ("/proc/page.html", "/proc")):
            self.assertIn(word, twinarm("export", self.ball.recording, place, code=2).stderr)
        self.assertIn("--csv", twinarm("export", self.ball.recording, "page.html", "--csv", code=2).stderr)


@unittest.skipUnless(find_browser(), NO_BROWSER)
class InTheBrowser(Pages):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.browser = cls.enterClassContext(page_browser())

    def open(self, page, hash_="", dark=False):
        self.browser.prefer(dark)
        self.browser.open(page.file.as_uri() + hash_)
        return self.browser

    def check_quiet(self, browser, page):
        self.assertEqual(browser.errors, [])
        others = [url for url in browser.requests
                  if not url.startswith((page.file.as_uri(), "data:", "blob:", "about:"))]
        self.assertEqual(others, [])

    def test_opens_from_a_file_without_console_messages(self):
        for dark in (False, True):
            browser = self.open(self.arm, "#t=1.5", dark=dark)
            self.picture(browser, f"arm_{'dark' if dark else 'light'}")
            self.check_quiet(browser, self.arm)

    def test_numbers_in_the_page_equal_the_recording(self):
        browser = self.open(self.arm)
        frames = self.arm.exported_frames()
        for i, column in enumerate(self.arm.exported["columns"]):
            got = browser.evaluate("Array.from(window.twinarm.run.channels.find("
                                   f"c => c.name === {json.dumps(column['name'])}).values)")
            self.assertEqual(got, [frame["values"][i] for frame in frames])
        shown = browser.evaluate("Object.fromEntries([...document.querySelectorAll('[data-row]')]"
                                 ".map(cell => [cell.dataset.row, cell.textContent]))")
        for row, text in shown.items():
            self.assertEqual(float(text), frames[-1]["energy_balance"].get(row, 0))
        self.assertEqual(set(shown), set(self.arm.run["energy_balance"]["rows"]))
        facts = browser.evaluate("Object.fromEntries([...document.querySelectorAll('[data-fact]')]"
                                 ".map(cell => [cell.dataset.fact, cell.textContent]))")
        self.assertEqual(facts, dict(self.arm.run["facts"]))

    def test_slider_and_keys_seek(self):
        browser = self.open(self.arm)
        state = "window.twinarm.page.state"
        seen = []
        for share in (0.2, 0.5, 0.8):
            box = browser.evaluate("(() => { const b = document.querySelector('.transport input')"
                                   ".getBoundingClientRect(); return [b.x, b.y, b.width, b.height];"
                                   " })()")
            at = (box[0] + share * box[2], box[1] + box[3] / 2)
            browser.drag((at[0] - 3, at[1]), at)
            time = browser.evaluate(f"{state}.time")
            self.assertAlmostEqual(time, share * self.arm.run["times"][-1], delta=0.1)
            seen.append(self.pixels(browser))
            self.picture(browser, f"arm_at_{int(100 * share)}")
        self.assertEqual(len(set(seen)), 3)
        browser.press("Home")
        self.assertEqual(browser.evaluate(f"{state}.frame"), 0)
        browser.press("ArrowRight")
        browser.press("ArrowRight")
        browser.press("ArrowLeft")
        self.assertEqual(browser.evaluate(f"{state}.frame"), 1)
        browser.press("End")
        last = len(self.arm.run["times"]) - 1
        self.assertEqual(browser.evaluate(f"{state}.frame"), last)
        browser.press(" ")
        browser.wait_for(f"{state}.playing && {state}.time > 0.05")
        browser.press(" ")
        self.assertFalse(browser.evaluate(f"{state}.playing"))
        self.check_quiet(browser, self.arm)

    def pixels(self, browser):
        """Screenshot of the 3-D view."""
        browser.evaluate("document.querySelectorAll('.switches, .legend, .views, .labels')"
                         ".forEach(e => e.style.visibility = 'hidden')")
        box = browser.evaluate("(() => { const b = document.querySelector('.stage')"
                               ".getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()")
        clip = dict(zip(("x", "y", "width", "height"), box), scale=1)
        return browser.call("Page.captureScreenshot", format="png", clip=clip)["data"]

    def test_orientation_of_a_texture(self):
        browser = self.open(self.flag)
        browser.evaluate("[...document.querySelectorAll('.views button')]"
                         ".find(b => b.textContent === 'front').click()")
        browser.frames(3)
        self.picture(browser, "flag")
        points = browser.evaluate("""[[0.25, 0.75], [0.75, 0.75], [0.5, 0.25]].map(([x, z]) => {
            const box = document.querySelector('.stage').getBoundingClientRect();
            const at = window.twinarm.page.stage.project(x, 0, z);
            return [Math.round(box.x + at.x), Math.round(box.y + at.y)];
        })""")
        for got, wanted in zip(browser.colors(points), (RED, GREEN, BLUE)):
            self.assertEqual(got.index(max(got)), wanted.index(max(wanted)), got)
            self.assertGreater(max(got), 2 * sorted(got)[1], got)

    def test_labels_do_not_overlap_controls(self):
        browser = self.open(self.arm, "#t=1.5&show=labels,couplings,forces,joints,frames")
        hidden = """(() => {
            const box = (e) => e.getBoundingClientRect();
            const bars = [...document.querySelectorAll('.switches, .legend, .views')].map(box);
            const shown = [...document.querySelectorAll('.labels span')].filter(e => !e.hidden);
            const meet = (a, b) => a.left < b.right && b.left < a.right
                && a.top < b.bottom && b.top < a.bottom;
            return [shown.length, shown.filter(e => bars.some(bar => meet(box(e), bar))).length];
        })()"""
        seen = []
        for _ in range(8):  # around the scene
            browser.evaluate("window.twinarm.page.stage.orbit(0.7, 0, 1)")
            browser.frames(2)
            count, covered = browser.evaluate(hidden)
            seen.append(count)
            self.assertEqual(covered, 0)
        self.assertGreater(max(seen), 3)
        self.picture(browser, "arm_labels")

    def test_each_layer_toggles(self):
        browser = self.open(self.arm, "#t=1.5")
        names = browser.evaluate("[...document.querySelectorAll('[data-layer]')].map(box => box.dataset.layer)")
        self.assertLessEqual({"targets", "couplings", "contacts", "joints", "com", "trails", "labels"}, set(names))
        before = browser.evaluate("window.twinarm.page.state.layers")
        for number in range(1, 10):
            browser.press(str(number))
        after = browser.evaluate("window.twinarm.page.state.layers")
        self.assertEqual(set(before) ^ set(after), set(names[:9]))
        self.picture(browser, "arm_other_layers")
        for name in names:
            browser.evaluate(f"document.querySelector('[data-layer={name}]').checked || "
                             f"document.querySelector('[data-layer={name}]').click()")
        browser.frames(2)
        self.picture(browser, "arm_all_layers")
        self.assertEqual(set(browser.evaluate("window.twinarm.page.state.layers")), {"bodies", *names})
        self.check_quiet(browser, self.arm)

    def test_plots_energy_and_setup_tabs(self):
        browser = self.open(self.arm, "#t=2")
        plots = browser.evaluate("[...document.querySelectorAll('.plot')].map(plot => plot.id)")
        self.assertLessEqual({"plot-angles", "plot-error", "plot-energy_balance", "plot-couplings",
                              "plot-contacts"}, set(plots))
        for key, name in (("l", "energy"), ("u", "setup"), ("p", "plots")):
            browser.press(key)
            self.picture(browser, f"arm_{name}")
        shown = browser.evaluate("document.querySelector('#command').textContent")
        self.assertEqual(shown, self.arm.run["command"])
        browser.press("t")
        self.assertEqual(browser.evaluate("document.documentElement.dataset.theme"), "dark")
        self.check_quiet(browser, self.arm)

    def test_drag_rotates_the_view(self):
        browser = self.open(self.ball, "#t=0.5")
        before = browser.evaluate("window.twinarm.page.state.eye")
        browser.drag((300, 200), (400, 180))
        self.assertNotEqual(before, browser.evaluate("window.twinarm.page.state.eye"))
        browser.press("r")
        after = browser.evaluate("window.twinarm.page.state.eye")
        for a, b in zip(before, after):
            self.assertAlmostEqual(a, b, places=9)
        self.picture(browser, "ball")
        self.check_quiet(browser, self.ball)


if __name__ == "__main__":
    main()
