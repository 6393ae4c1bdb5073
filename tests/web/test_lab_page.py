#!/usr/bin/env python3
"""The lab's page in a real browser: a newcomer's first minutes, hand, knobs, time, files.

    test_lab_page.py PATH/TO/twinarm [FOLDER_FOR_PICTURES]
"""
import csv
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from browser import Browser, find_browser

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/lab"))
from live_socket import Lab  # noqa: E402

PROGRAM = None
PICTURES = None
SCENE = ROOT / "assets/scenes/hand_and_obstacles.toml"
ROD = """<robot name="rod"><link name="base"/>
<link name="rod"><inertial><origin xyz="0 0 -0.5"/><mass value="1"/>
<inertia ixx="0.1" iyy="0.1" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><origin xyz="0 0 -0.5"/><geometry><box size="0.1 0.1 1"/></geometry></visual></link>
<joint name="hinge" type="continuous"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/></joint>
</robot>"""
STATE = "twinarm.page.state"
KNOB = "document.getElementById('knob-coupling-0--%s')"


def program(*words):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=120,
                          check=True).stdout


class LabPage(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        self.process = subprocess.Popen([PROGRAM, "lab", str(SCENE), "--json", "--no-browser"],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.url = json.loads(self.process.stdout.readline())["url"]
        self.page = Browser(width=1280, height=720)
        self.page.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=self.folder.name)
        self.page.open(self.url)

    def tearDown(self):
        errors = list(self.page.errors)
        self.page.__exit__(None, None, None)
        self.process.send_signal(signal.SIGINT)
        _, said = self.process.communicate(timeout=30)
        self.assertEqual((self.process.returncode, said), (0, ""))
        self.assertEqual(errors, [])
        self.folder.cleanup()

    def picture(self, name):
        if PICTURES:
            self.page.frames(3)
            self.page.picture(PICTURES / f"lab_{name}.png")

    def value(self, expression):
        return self.page.evaluate(expression)

    def until(self, expression):
        self.page.wait_for(f"!!({expression})")

    def click(self, text, within="document"):
        """A button by its words."""
        self.until(f"[...{within}.querySelectorAll('button')].some(b => b.offsetParent && "
                   f"b.textContent.trim().startsWith({text!r}))")
        self.value(f"[...{within}.querySelectorAll('button')].find(b => b.offsetParent && "
                   f"b.textContent.trim().startsWith({text!r})).click()")

    def channel(self, name):
        return self.value("(p => p.frame.channels[p.scene.channels.findIndex(c => c.name === "
                          f"{name!r})])(twinarm.page)")

    def type_into(self, field, text):
        """As a person does: all of it replaced, then Enter."""
        self.value(f"{field}.scrollIntoView(); {field}.focus(); {field}.select()")
        self.page.call("Input.insertText", text=text)
        for kind in ("keyDown", "keyUp"):
            self.page.call("Input.dispatchKeyEvent", type=kind, key="Enter", code="Enter",
                           windowsVirtualKeyCode=13, text="\r" if kind == "keyDown" else "")

    def mouse(self, kind, at):
        self.page.call("Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button="left",
                       buttons=1, clickCount=1)

    def downloaded(self, end):
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            found = [f for f in self.path.iterdir() if f.name.endswith(end)]
            if found and found[0].stat().st_size > 0:
                return found[0]
            time.sleep(0.1)
        self.fail(f"no {end} in {[f.name for f in self.path.iterdir()]}")

    def drag_tip(self, right, down):
        ring = "document.querySelector('button.grip').getBoundingClientRect()"
        x, y = self.value(f"(r => [r.x + r.width / 2, r.y + r.height / 2])({ring})")
        self.mouse("mouseMoved", (x, y))
        self.mouse("mousePressed", (x, y))
        for i in range(1, 11):
            self.mouse("mouseMoved", (x + right * i / 10, y + down * i / 10))
            time.sleep(0.05)
        return x + right, y + down

    def test_the_dynamic_robot_follows_a_tip_that_is_dragged(self):
        self.assertIn("ten obstacles", self.value("document.querySelector('h1').textContent"))
        self.picture("start")
        before = self.channel("q/joint1")
        end = self.drag_tip(-90, 20)
        self.until("twinarm.page.state.hand.source === 'drag'")
        deadline = time.monotonic() + 30
        while abs(self.channel("q/joint1") - before) < 0.2 and time.monotonic() < deadline:
            time.sleep(0.2)
        self.picture("dragged")
        self.assertGreater(abs(self.channel("q/joint1") - before), 0.2)
        self.assertAlmostEqual(self.channel("q/joint1"), self.channel("target/joint1"), delta=0.5)
        self.mouse("mouseReleased", end)

    def test_a_body_is_selected_and_looked_into_and_overlays_come_and_go(self):
        self.value("twinarm.page.select(2)")
        self.click("Glass")
        self.until("document.querySelector('aside').textContent.includes('arm1')")
        self.until("document.querySelectorAll('aside math').length > 0")
        self.picture("glass")
        self.click("Show")
        shown = "twinarm.page.overlays.names"
        for name in ("frames", "inertia"):
            layer = self.value(f"twinarm.page.scene.layers.findIndex(l => l.name === {name!r})")
            count = (f"(f => f.first[{layer + 1}] - f.first[{layer}])(twinarm.page.frame)")
            self.assertEqual(self.value(count), 0)
            self.value(f"document.querySelector('.overlays [data-layer={name}], .overlays "
                       f"input[value={name}]').click()")
            self.until(f"{shown}.includes({name!r})")
            self.until(f"{count} > 0")
        self.picture("overlays")
        self.page.open(self.url)  # a page that reloads finds everything as it was
        self.until(f"{shown}.includes('frames')")

    def test_beyond_the_limit_it_stops_says_why_and_the_remedy_holds(self):
        self.until(f"{STATE}.time > 0.5")
        self.value("twinarm.page.send({do: 'set', changes: ['coupling[0].treatment=explicit']})")
        self.until(f"{STATE}.changes.length === 1")
        self.until(f"{STATE}.knobs.find(k => k.path === 'coupling[0].stiffness').limit?.value > 0")
        limit = self.value(f"{STATE}.knobs.find(k => k.path === 'coupling[0].stiffness').limit.value")
        self.type_into(KNOB % "stiffness", f"{0.9 * limit:.3g}")
        self.until("document.querySelector('.predicted .near')")
        self.assertIsNone(self.value(f"{STATE}.dead"))
        self.picture("amber")
        self.type_into(KNOB % "stiffness", f"{20 * limit:.3g}")
        self.until(f"{STATE}.changes.length === 2")
        self.value("twinarm.page.send({do: 'pull', body: 3, point: [0, 0, 0], goal: [1, 1, 1]})")
        self.until(f"{STATE}.dead")
        self.until("!document.querySelector('.post-mortem').hidden")
        self.picture("post_mortem")
        self.click(self.value(f"{STATE}.dead.remedies[0].words"))
        self.until(f"{STATE}.branch && !{STATE}.dead && {STATE}.playing")
        then = self.value(f"{STATE}.time")
        self.until(f"{STATE}.time > {then} + 1")
        self.assertIsNone(self.value(f"{STATE}.dead"))

    def test_time_goes_back_and_on_in_a_branch(self):
        self.until(f"{STATE}.time > 3")
        bar = "document.querySelector('input[type=range][title^=instant], " \
              "input[type=range][aria-label^=instant]')"
        self.value(f"{bar}.value = (+{bar}.min + +{bar}.max) / 2; "
                   f"{bar}.dispatchEvent(new Event('input', {{bubbles: true}}))")
        self.until(f"{STATE}.at !== null && twinarm.page.frame.lookedBack")
        self.picture("back")
        at = self.value(f"{STATE}.at")
        self.click("branch")
        self.picture("branch_dialog")
        self.click("Branch", "document.querySelector('dialog[open]')")
        self.until(f"{STATE}.branch !== null && {STATE}.at === null")
        self.assertAlmostEqual(self.value(f"{STATE}.branch.from"), at, delta=0.1)
        self.until(f"{STATE}.time > {STATE}.branch.from + 0.5")

    def test_a_robot_is_dropped_and_a_bad_one_is_told_of(self):
        scene = self.value("twinarm.page.scene.scene")
        drop = """(text => { const data = new DataTransfer();
            data.items.add(new File([text], 'fresh.urdf'));
            for (const kind of ['dragenter', 'dragover', 'drop']) document.body.dispatchEvent(
                new DragEvent(kind, {bubbles: true, cancelable: true, dataTransfer: data})); })(%s)"""
        self.value(drop % json.dumps(ROD))
        self.until(f"twinarm.page.scene.scene > {scene} && twinarm.page.scene.file === 'fresh.urdf'")
        self.until("twinarm.page.frame?.scene === twinarm.page.scene.scene")
        self.picture("dropped")
        self.value(drop % json.dumps(ROD.replace('type="continuous"', 'type="bendy"')))
        self.until("document.body.innerText.includes('bendy')")
        self.page.errors.clear()  # the browser's own word for 422

    def test_numbers_of_the_page_are_those_of_the_recording(self):
        self.click("Plots")
        self.drag_tip(-60, 0)
        self.until(f"{STATE}.time > 3")
        self.value("twinarm.page.send({do: 'play', on: false})")
        self.until(f"!{STATE}.playing")
        self.picture("plots")
        self.click("all CSV")
        with open(self.downloaded(".csv"), newline="", encoding="utf-8") as file:
            rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
        head, rows = rows[0], rows[1:]
        lab = Lab(self.url)
        recording = self.path / "saved"
        recording.write_bytes(lab.get("/save").body)
        told = json.loads(program("export", recording, "--json"))
        names = [column["name"] for column in told["columns"]]
        frames = {round(f["t"], 9): dict(zip(names, f["values"])) for f in told["frames"]}
        column = next(i for i, name in enumerate(head) if name.startswith("q/joint1"))
        both = 0
        for row in rows:
            frame = frames.get(round(float(row[0]), 9))
            if frame:
                both += 1
                self.assertEqual(float(row[column]), frame["q/joint1"])
        self.assertGreater(both, 10)
        self.assertGreater(len(lab.get("/share").body), 100_000)

    def test_dark_and_on_a_tablet(self):
        self.value("[...document.querySelectorAll('header button')].find(b => "
                   "b.title.startsWith('light')).click()")
        self.until("document.documentElement.dataset.theme === 'dark'")
        self.picture("dark")
        self.page.call("Emulation.setDeviceMetricsOverride", width=820, height=1180,
                       deviceScaleFactor=1, mobile=True)
        self.page.frames(5)
        self.picture("tablet")
        self.assertLessEqual(self.value("document.documentElement.scrollWidth"), 820)


def page_is_there():
    """False, with a line, where there is no browser or the program has no pages."""
    if not find_browser():
        print("test_lab_page: skipped: no Chromium here; scripts/setup --lab installs it")
        return False
    process = subprocess.Popen([PROGRAM, "lab", str(SCENE), "--json", "--no-browser"],
                               stdout=subprocess.PIPE, text=True)
    try:
        Lab(json.loads(process.stdout.readline())["url"])
        return True
    except ConnectionError as error:
        print(f"test_lab_page: skipped: {error}")
        return False
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-") and "." not in sys.argv[1]:
        PICTURES = pathlib.Path(sys.argv.pop(1))
        PICTURES.mkdir(parents=True, exist_ok=True)
    if page_is_there():
        unittest.main()
