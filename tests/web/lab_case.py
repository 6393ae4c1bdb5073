"""Common parts of the tests of the lab's page in a browser."""
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

from browser import NO_BROWSER, Browser, find_browser, folder_for_pictures

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))
import program
from live_socket import Lab
from waiting import TIMEOUT, wait_for

SCENE = ROOT / "assets/scenes/hand_and_obstacles.toml"
STATE = "twinarm.page.state"
PARAMETER = "document.getElementById('parameter-coupling-0--%s')"


class Program:
    """`twinarm lab`, at .url; ends with the block."""

    def __init__(self, program, scene=SCENE, *options):
        self.process = subprocess.Popen([program, "lab", str(scene), "--json", "--no-browser", *options],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.url = json.loads(self.process.stdout.readline())["url"]

    def end(self):
        """Its exit code and stderr."""
        self.process.send_signal(signal.SIGINT)
        _, errors = self.process.communicate(timeout=TIMEOUT)
        return self.process.returncode, errors


class LabCase(unittest.TestCase):
    """One browser for all tests; a lab for each test, at its own port, so that the browser has no data of it."""
    program = None
    pictures = None  # a folder

    @classmethod
    def setUpClass(cls):
        if reason := why_no_page(cls.program):
            raise unittest.SkipTest(reason)
        cls.page = Browser(width=1280, height=720, scale=1 if cls.pictures else 0.25)
        cls.addClassCleanup(cls.page.__exit__)

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        self.lab = Program(self.program)
        self.url = self.lab.url
        self.page.resize(1280, 720)
        self.page.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=self.folder.name)
        self.page.open(self.url)
        if not self.pictures:  # few pictures per second: each takes 35 ms in software rendering
            self.page.evaluate("twinarm.page.live.interval = 150")

    def tearDown(self):
        errors = list(self.page.errors)
        self.page.call("Page.navigate", url="about:blank")  # before the lab ends
        self.assertEqual(self.lab.end(), (0, ""))
        self.assertEqual(errors, [])
        self.folder.cleanup()

    def picture(self, name):
        if self.pictures:
            self.page.frames(3)
            self.page.picture(self.pictures / f"lab_{name}.png")

    def value(self, expression):
        return self.page.evaluate(expression)

    def until(self, expression):
        self.page.wait_for(f"!!({expression})")

    def click(self, text, within="document"):
        """Clicks a button by its text, once it is shown and enabled."""
        self.until(f"[...{within}.querySelectorAll('button')].some(b => b.offsetParent && !b.disabled && "
                   f"b.textContent.trim().startsWith({text!r}))")
        self.value(f"[...{within}.querySelectorAll('button')].find(b => b.offsetParent && "
                   f"b.textContent.trim().startsWith({text!r})).click()")

    def channel(self, name):
        return self.value("(p => p.frame.channels[p.scene.channels.findIndex(c => c.name === "
                          f"{name!r})])(twinarm.page)")

    def type_into(self, field, text):
        """Replaces the text of a field and presses Enter."""
        self.value(f"{field}.scrollIntoView(); {field}.focus(); {field}.select()")
        self.page.call("Input.insertText", text=text)
        self.page.press("Enter")

    def mouse(self, kind, at):
        self.page.call("Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button="left", buttons=1, clickCount=1)

    def downloaded(self, end):
        return wait_for(lambda: next((f for f in self.path.iterdir() if f.name.endswith(end) and f.stat().st_size > 0),
                                     None), f"a download {end}")

    def drag_tip(self, right, down):
        self.value("twinarm.page.live.interval = 0")  # the handle is where the picture shows it
        self.page.frames(3)
        ring = "document.querySelector('button.grip').getBoundingClientRect()"
        x, y = self.value(f"(r => [r.x + r.width / 2, r.y + r.height / 2])({ring})")
        self.mouse("mouseMoved", (x, y))
        self.mouse("mousePressed", (x, y))
        for i in range(1, 11):
            self.mouse("mouseMoved", (x + right * i / 10, y + down * i / 10))
            self.page.frames(2)
        return x + right, y + down


def why_no_page(program):
    """The reason why the page cannot be opened here, or None."""
    if not find_browser():
        return NO_BROWSER
    lab = Program(program)
    try:
        Lab(lab.url)
        return None
    except ConnectionError as error:
        return f"{error}: scripts/setup --lab, then build"
    finally:
        lab.end()


def main():
    """TEST.py PATH/TO/twinarm [FOLDER_FOR_PICTURES] [options of unittest]"""
    LabCase.program = sys.argv[1]
    LabCase.pictures = folder_for_pictures()
    program.main()
