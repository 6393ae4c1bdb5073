"""Tasks of somebody who sees the lab for the first time: each in at most twelve actions, by mouse and by touch.

    test_newcomer_tasks.py PATH/TO/twinarm [FOLDER_FOR_PICTURES]
"""
from lab_case import LabCase, main
from newcomer import (BACKGROUND, RING, UNREACHABLE, Choose, Click, Drag, Key, Remember, See, Tap, Type, User, along,
                      body)

MAX_ACTIONS = 12
CLOCK = "parseFloat(document.querySelector('.clock').textContent)"
WHERE = "document.querySelector('.where').textContent"
TITLE = "document.querySelector('h1').textContent"
SCENES = "document.querySelector('header .labelled')"
TIME = ".transport input[type=range]"
CARD = "document.querySelector('.post-mortem')"
STIFFNESS = "document.getElementById('parameter-coupling-0--stiffness')"
RUNS = [Remember("clock", CLOCK), See(f"{CLOCK} > seen.clock + 0.2")]


def shown(selector):
    return f"document.querySelector({selector!r})?.checkVisibility()"


def moved(point, name, by):
    return f"(([x, y], [u, v]) => Math.hypot(x - u, y - v) > {by})({point}, seen.{name})"


def tip(right, down):
    """A drag of the ring that the ring follows."""
    return [Remember("ring", RING), Drag(RING, right, down), See(moved(RING, "ring", 4))]


# There and back, in eight directions.
EIGHT = [action for right, down in ((50, 0), (-50, 0), (0, -50), (0, 50), (35, -35), (-35, 35), (-35, -35), (35, 35))
         for action in tip(right, down)]
PREDICTED = "[data-path='coupling[0].stiffness'] .predicted:not(:empty)"  # it moves the fields below it
EXPLODE = [Choose("pull_arm1: discretization", "explicit"), See(shown(PREDICTED)),
           Click("pull_arm1: stiffness k in N/m"), Type("3e7"), Key("Enter"),
           See(f"parseFloat({STIFFNESS}.value) === 3e7"), Drag(RING, -60, 20),
           See(f"{CARD}.checkVisibility() && {CARD}.textContent.includes('Stable settings')")]

TASKS = {
    "drag the tip in eight directions": [Click("fit"), *EIGHT],
    "drag the tip in eight directions from the front": [Click("front"), *EIGHT],
    "drag the tip in eight directions from above": [Click("top"), *EIGHT],
    "make it diverge and take a remedy": [
        *EXPLODE, Tap("(r => [r.x + r.width / 2, r.y + r.height / 2])"
                      f"({CARD}.querySelector('.remedies button').getBoundingClientRect())"),
        See(f"!{CARD}.checkVisibility()"), *RUNS],
    "see the divergence in slow motion": [
        *EXPLODE, Click("Replay the last second"), See(f"{WHERE}.includes('ago')")],
    "restart": [See(f"{CLOCK} > 1.5"), Click("restart"), See(f"{CLOCK} < 1"), *RUNS],
    "go back and branch": [
        See(f"{CLOCK} > 2"), Drag(along(TIME, None), end=along(TIME, 0.5)), Click("branch"), Click("Branch"),
        See(shown(".branch-mark")), *RUNS],
    "pull a crate": [
        Click("Scenes"), Click("Stack of ten boxes"), See(f"{TITLE}.includes('Stack')"), Remember("crate", body()),
        Drag(body(), 60, -30, hold="document.querySelector('.spring-force').textContent.includes('N')")],
    "read a force": [
        Click("Scenes"), Click("Stack of ten boxes"), See(
            f"{TITLE}.includes('Stack')"), Click("Show"), Click("contacts"),
        See("[...document.querySelectorAll('.labels span')].some(at => at.textContent.includes(' N'))")],
    "export a curve": [Click("Plots"), Click("CSV"), ".csv"],
    "open another scene": [
        Click("Scenes"), Click("Gyroscopic precession"), See(f"{TITLE}.includes('Gyroscopic')"), *RUNS],
    "slow motion": [Choose("speed", "1/10×"), See(f"{WHERE}.includes('1/10× slow')")],
    "look at an earlier instant and return": [
        See(f"{CLOCK} > 2"), Drag(along(TIME, None), end=along(TIME, 0.3)), See(f"{WHERE}.includes('s ago')"),
        Click("to now"), See(f"!{WHERE}.includes('ago')")],
    "pause, one step, play": [
        Click("pause"), See(f"{WHERE} === 'paused'"), Remember("clock", CLOCK), Click("one step"),
        See(f"{CLOCK} > seen.clock && {CLOCK} < seen.clock + 0.01"), Click("play"), *RUNS],
    "show an overlay": [
        Remember("drawn", "twinarm.page.frame.first.at(-1)"), Click("Show"), Click("frames"),
        See("twinarm.page.frame.first.at(-1) > seen.drawn")],
    "fold the legend": [See(shown(".legend ul")), Click("Legend"), See(f"!{shown('.legend ul')}")],
    "share a state": [See(f"{CLOCK} > 1"), Click("Save"), Click("Replay page"), ".html"],
    "rotate the view and fit it again": [
        Remember("ring", RING), Drag(BACKGROUND, 120, 10), See(moved(RING, "ring", 10)), Click("fit"),
        See(f"!{moved(RING, 'ring', 6)}")],
    "select a body and inspect it": [
        Tap(body()), See("!document.querySelector('.handles .tag').hidden"), Click("Inspector"),
        See("document.querySelectorAll('.inspector math').length > 0")],
    "change a parameter and reset": [
        Remember("value", f"{STIFFNESS}.value"),
        Drag(along("[data-path='coupling[0].stiffness'] input[type=range]", None), 40, 0),
        See(f"{STIFFNESS}.value !== seen.value"), Click("Reset"), See(f"{STIFFNESS}.value === seen.value")],
    "follow a body": [Choose("body to follow", "follow arm2"), See("twinarm.page.views.body !== null")],
    "close and open what to look for": [
        Click("close"), See(f"!{shown('.look')}"), Click("What to look for"), See(shown(".look"))],
    "hide and show the panel": [
        Click("hide or show the panel"), See(f"!{shown('aside')}"), Click("hide or show the panel"),
        See(shown("aside"))],
    "dark": [Click("light or dark"), See("document.documentElement.dataset.theme === 'dark'")],
    "large type": [
        Remember("width", f"{SCENES}.getBoundingClientRect().width"), Click("A+"),
        See(f"{SCENES}.getBoundingClientRect().width > 1.3 * seen.width"), Click("Plots"), Click("A+")],
    # One's own robot: test_own_robot.py.
}
BY_KEYBOARD = {
    "move the tip": [Remember("ring", RING), Key("h"), *4 * [Key("ArrowLeft")], See(moved(RING, "ring", 4))],
    "pause, go back, branch": [
        See(f"{CLOCK} > 2"), Key(" "), See(f"{WHERE} === 'paused'"), Key("ArrowLeft"), See(f"{WHERE}.includes('ago')"),
        Key("b"), See(shown("dialog.branch")), Key("Tab"), Key("Tab"), Key("Enter"), See(shown(".branch-mark"))],
    "open another scene": [Key("e"), Key("Tab"), Key("ArrowRight"), Key("Enter"), See("!document.querySelector"
                                                                                      "('dialog[open]')"), *RUNS],
}
WINDOWS = {"mouse": (1280, 720), "touch": (820, 1180)}


class NewcomerTasks(LabCase):
    def tearDown(self):
        self.page.call("Emulation.setTouchEmulationEnabled", enabled=False)
        super().tearDown()

    def test_no_control_is_covered_or_smaller_than_24_pixels(self):
        for width, height in ((1920, 1080), (1280, 720), (1024, 768), (390, 844)):
            self.page.resize(width, height)
            self.page.open(self.url)
            for tab in ("Parameters", "Plots", "Inspector", "Energy"):
                self.click(tab)
                self.page.frames(10)
                with self.subTest(window=(width, height), tab=tab):
                    self.assertEqual("\n".join(self.value(f"{UNREACHABLE}(document)")), "")
            self.click("Show")
            with self.subTest(window=(width, height), opened="overlays"):
                list_ = "document.querySelector('.overlays')"
                self.assertEqual("\n".join(self.value(f"{UNREACHABLE}({list_})")), "")

    def perform(self, actions, way):
        if way == "touch":
            self.page.resize(*WINDOWS[way], mobile=True)
            self.page.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)
            self.page.open(self.url)
            self.page.frames(5)
        user = User(self.page, way == "touch")
        for action in actions:
            if isinstance(action, str):
                self.assertGreater(self.downloaded(action).stat().st_size, 100)
            else:
                user.do([action])
        self.assertLessEqual(user.actions, MAX_ACTIONS)
        return user.actions


def add_test(name, actions, way):
    def test(self):
        count = self.perform(actions, way)
        print(f"{count:3} actions by {way}: {name}", flush=True)
    test.__name__ = f"test_{name.replace(' ', '_').replace(',', '').replace(chr(39), '')}_by_{way}"
    setattr(NewcomerTasks, test.__name__, test)


for task, steps in TASKS.items():
    for tool in WINDOWS:
        add_test(task, steps, tool)
for task, steps in BY_KEYBOARD.items():
    add_test(task, steps, "keyboard")

if __name__ == "__main__":
    main()
