"""No page violates a rule of WCAG 2.1, levels A and AA, that axe-core checks, in light and dark: the lab in its
states, the pages of `export`, `inspect` and `compare`, the documentation.

    test_accessibility.py PATH/TO/twinarm [FOLDER_FOR_PICTURES]
"""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import program
from axe import violations
from browser import NO_BROWSER, Browser, find_browser
from lab_case import STATE, LabCase, main
from waiting import TIMEOUT

ROOT = pathlib.Path(__file__).resolve().parents[2]
HAS_GENERATOR = bool(shutil.which("sphinx-build") and pathlib.Path("/usr/share/javascript/katex").is_dir())
DOCUMENTATION = ("index", "use/lab", "understand/contact", "reference/glossary", "reference/commands",
                 "learn/lessons/01_six_integrators/lesson", "search", "genindex")


class LabStates(LabCase):
    def setUp(self):
        super().setUp()
        self.addCleanup(self.page.prefer, False)

    def check(self, state):
        for dark in (False, True):
            self.page.prefer(dark)
            self.until(f"document.documentElement.dataset.theme === '{'dark' if dark else 'light'}'")
            self.page.frames(3)
            with self.subTest(state=state, dark=dark):
                self.assertEqual("\n".join(violations(self.page)), "")
                self.picture(f"axe_{state.replace(' ', '_')}_{'dark' if dark else 'light'}")

    def test_start_and_tabs(self):
        self.until(f"{STATE}.time > 0.5")
        self.check("start")
        self.value("twinarm.page.select(2)")
        for tab in ("Plots", "Inspector", "Energy"):
            self.click(tab)
            self.page.frames(20)
            self.check(tab)

    def test_menus_and_dialogs(self):
        self.click("Show")
        self.check("overlays")
        self.page.press("Escape")
        for menu in ("Save", "Messages"):
            summary = f"[...document.querySelectorAll('summary')].find(s => s.textContent.startsWith({menu!r}))"
            self.value(f"{summary}.click()")
            self.check(f"menu {menu}")
            self.value(f"{summary}.click()")
        for key, dialog in (("e", "scenes"), ("?", "keys"), ("b", "branch")):
            self.page.press(key)
            self.until("document.querySelector('dialog[open]')")
            self.check(f"dialog {dialog}")
            self.page.press("Escape")

    def test_past_branch_and_view_only(self):
        self.until(f"{STATE}.time > 1")
        self.page.press("ArrowLeft", shift=True)
        self.until(f"{STATE}.at !== null")
        self.check("earlier instant")
        self.page.press("b")
        self.click("Branch", "document.querySelector('dialog[open]')")
        self.until(f"{STATE}.branch !== null")
        self.check("branch")
        with Browser() as other:
            other.open(self.url)
            other.wait_for("!!twinarm.page.state && twinarm.page.state.controller !== null")
            self.assertEqual("\n".join(violations(other)), "")

    def test_limits_and_divergence(self):
        self.until(f"{STATE}.time > 0.5")
        self.value("twinarm.page.send({do: 'set', changes: ['coupling[0].discretization=explicit']})")
        self.until(f"{STATE}.parameters.find(k => k.path === 'coupling[0].stiffness').limit?.value > 0")
        self.value("twinarm.page.send({do: 'set', changes: ['coupling[0].stiffness=3e7']})")
        self.until(f"{STATE}.changes.includes('coupling[0].stiffness=3e7')")
        self.value("twinarm.page.send({do: 'drag_body', body: 3, point: [0, 0, 0], goal: [1, 1, 1]})")
        self.until(f"{STATE}.failure && !{STATE}.failure.trying")
        self.until("!document.querySelector('.post-mortem').hidden")
        self.check("post-mortem")

    def test_other_scenes(self):
        for name in ("puma_under_hand", "gyroscope", "four_bar", "box_stack"):
            self.value(f"twinarm.page.send({{do: 'scene', name: {name!r}}})")
            self.until(f"{STATE}.name === {name!r} && twinarm.page.frame?.scene === twinarm.page.scene.scene")
            self.page.frames(3)
            with self.subTest(name):
                self.assertEqual("\n".join(violations(self.page)), "")

    def test_telephone(self):
        self.page.resize(390, 844, mobile=True)
        self.check("telephone")


@unittest.skipUnless(find_browser(), NO_BROWSER)
class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.page = cls.enterClassContext(Browser())

    def check(self, file, ready="document.readyState === 'complete'", hash_="", prepare="0"):
        for dark in (False, True):
            self.page.prefer(dark)
            self.page.call("Page.navigate", url="about:blank")
            self.page.call("Page.navigate", url=file.as_uri() + hash_)
            self.page.wait_for(f"location.protocol === 'file:' && ({ready})")
            self.page.evaluate(prepare)
            self.page.frames(3)
            with self.subTest(page=file.name + hash_, dark=dark, prepare=prepare):
                self.assertEqual("\n".join(violations(self.page)), "")

    def test_replay_page(self):
        recording, page = self.folder / "run.twinrec", self.folder / "run.html"
        program.twinarm("simulate", "assets/scenes/robot_beside_obstacles.toml", "--record", recording)
        program.twinarm("export", recording, page)
        for tab in range(3):
            click = f"document.getElementById('tab-{tab}').click()"
            self.check(page, "document.documentElement?.dataset.ready === 'true'", prepare=click)

    def test_inspect_page(self):
        page = self.folder / "inspect.html"
        program.twinarm("inspect", "assets/robots/s103/s103.urdf", "--html", page)
        for step in (1, 5, 10, 13):
            self.check(page, "document.documentElement?.dataset.ready === 'true'", f"#step={step}")

    def test_compare_page(self):
        page = self.folder / "compare.html"
        program.twinarm("compare", "A1", "B1", "E1", "--html", page)
        self.check(page)

    @unittest.skipUnless(HAS_GENERATOR, "no Sphinx or KaTeX: scripts/setup --docs")
    def test_documentation(self):
        site = self.folder / "site"
        subprocess.run(["sphinx-build", "-q", "-c", ROOT / "docs/site", "-d", self.folder / "doctrees", "-b", "html",
                        ROOT / "docs", site], check=True, capture_output=True, timeout=TIMEOUT)
        for name in DOCUMENTATION:
            self.check(site / f"{name}.html")


if __name__ == "__main__":
    main()
