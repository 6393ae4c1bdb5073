"""Random input to the lab's page in a headless Chromium, reproducible by its seed: drags, keys, text, dropped
files, clicks. At the end the page must not have reloaded, must draw new frames, must not have logged errors,
and its memory must be bounded.

    lab_random_input.py [PATH/TO/twinarm] --minutes 10 --seed 1
"""
import argparse
import json
import pathlib
import random
import sys
import tempfile
import time

from browser import Browser
from lab_case import ROOT, STATE, Program, why_no_page
from test_lab_page import ROD

HEAP = 12e6  # allowed growth after garbage collection, in bytes
SKIPPED = 77  # as tests/support/run_test.py
REFUSED = ("422", "status of 4")  # the browser's messages for a rejected file


class RandomUser:
    def __init__(self, page, chance, say):
        self.page, self.chance, self.say = page, chance, say
        self.acts = {act[4:]: getattr(self, act) for act in dir(self) if act.startswith("act_")}
        self.done = dict.fromkeys(self.acts, 0)

    def value(self, expression):
        return self.page.evaluate(expression)

    def one(self):
        name = self.chance.choice(list(self.acts))
        self.acts[name]()
        self.done[name] += 1
        self.page.frames(self.chance.randint(1, 3))
        self.value("document.querySelector('dialog[open]')?.close()")

    def send(self, **command):
        self.value(f"twinarm.page.send({json.dumps(command)})")

    def click_one_of(self, selector):
        """Clicks a random visible element."""
        at = self.value("""(all => { const at = all[Math.floor(%r * all.length)];
            at?.scrollIntoView({block: 'nearest'});
            const box = at?.getBoundingClientRect();
            return box ? [box.x + box.width / 2, box.y + box.height / 2] : null; })(
            [...document.querySelectorAll(%r)].filter(at => at.checkVisibility() && !at.disabled))""" %
                        (self.chance.random(), selector))
        if at:
            self.page.drag(at, at)
        return at is not None

    def somewhere(self):
        x, y, width, height = self.value("(r => [r.x, r.y, r.width, r.height])"
                                         "(document.querySelector('.stage').getBoundingClientRect())")
        return x + width * self.chance.uniform(0.1, 0.9), y + height * self.chance.uniform(0.2, 0.8)

    def act_drag_the_view(self):
        self.page.drag(self.somewhere(), self.somewhere(), self.chance.choice(("left", "right")))

    def act_drag_the_tip(self):
        self.drag_from(self.value("""(at => { if (!at || at.hidden) return null;
            const r = at.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2];
            })(document.querySelector('button.grip'))"""))

    def act_drag_a_body_or_a_joint(self):
        self.drag_from(self.value("""((u) => { const {drag, frame, scene} = twinarm.page, seen = drag.view();
            if (!seen) return null;
            const moving = scene.bodies.flatMap(({moves}, i) => moves ? [i] : []);
            const body = moving[Math.floor(u * moving.length)];
            if (body === undefined) return null;
            const at = seen.stage.project(...frame.link.subarray(7 * body, 7 * body + 3));
            const {x, y} = seen.stage.host.getBoundingClientRect();
            return at && [x + at.x, y + at.y]; })(%r)""" % self.chance.random()))

    def drag_from(self, at):
        if not at or not all(0 < v < 4000 for v in at):
            return
        self.page.drag(at, (at[0] + self.chance.gauss(0, 80), at[1] + self.chance.gauss(0, 60)))

    def act_parameter(self):
        """Also far outside the range of the slider."""
        parameters = self.value(f"{STATE}.parameters")
        if not parameters:
            return
        parameter = self.chance.choice(parameters)
        if parameter["form"] == "choice":
            value = self.chance.choice(parameter["choices"] or ["nonsense"])
        else:
            low, high = (parameter["low"], parameter["high"]) if parameter["high"] > parameter["low"] else (-10, 10)
            value = self.chance.uniform(low, high)
            if parameter["form"] == "log" and low > 0:
                value = low * (high / low) ** self.chance.uniform(-0.1, 1.1)
        self.send(do="set", changes=[f"{parameter['path']}={value}"])

    def act_type_into_a_field(self):
        if self.click_one_of(".parameter input[type=text]"):
            for letter in self.chance.choice(("800", "1e9", "-1", "abc", "", "0", "3 ms", "NaN")):
                self.page.press(letter)
            self.page.press(self.chance.choice(("Enter", "Escape", "Tab")))

    def act_slider(self):
        if self.click_one_of("input[type=range]"):
            for _ in range(self.chance.randint(1, 6)):
                self.page.press(self.chance.choice(("ArrowLeft", "ArrowRight", "PageUp", "Home", "End")))

    def act_button(self):
        self.click_one_of("main button, main summary, header button, .post-mortem button")

    def act_take_a_remedy(self):
        self.click_one_of(".remedies button") or self.click_one_of(".parameters > button")

    def act_key(self):
        keys = list(" .,[]bhjxgcmMfadws+-rvo123456789npil\\et?") + [
            "Escape", "Tab", "End", "Enter", "ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "PageUp", "PageDown"]
        for _ in range(self.chance.randint(1, 10)):
            self.page.press(self.chance.choice(keys))

    def act_back_and_branch(self):
        state = self.value(STATE)
        at = self.chance.uniform(state["first"], state["last"])
        self.send(do="look", at=at)
        self.page.frames(5)
        if self.chance.random() < 0.6:
            self.send(do="branch", at=at, changes=[])
        else:
            self.send(do="look", at=None)
        self.send(do="play", on=True)

    def act_scene_or_preset(self):
        state = self.value(STATE)
        if self.chance.random() < 0.7:
            self.send(do="scene", name=self.chance.choice(state["gallery"])["name"])
        else:
            self.send(do="preset", name=self.chance.choice(state["presets"])["name"])
        self.page.frames(5)

    def act_overlay(self):
        self.value("twinarm.page.overlays.toggleNumber(%d)" % self.chance.randint(1, 9))

    def act_select(self):
        bodies = self.value("twinarm.page.scene?.bodies.length ?? 1")
        self.value("twinarm.page.select(%s)" % self.chance.choice(["null", *range(bodies)]))

    def act_drop_a_file(self):
        name, text = self.chance.choice((("rod.urdf", ROD), ("rod.xml", ROD), ("junk.dat", "junk" * 1000),
                                         ("bad.urdf", ROD[:200]), ("bad.toml", "[[robot]]\nname = 3"),
                                         ("not.twinrec", "TWINREC?"), ("cube.stl", "solid nothing")))
        self.page.drop(name, text)
        self.page.frames(5)

    def act_export(self):
        self.value("twinarm.page.showTab('Plots')")
        self.page.frames(5)
        self.click_one_of(".plot-bar button, .plot .small")
        path = self.chance.choice(("/save", "/share", "/scene"))
        self.value(f"fetch('{path}').then(answer => answer.arrayBuffer()).then(all => all.byteLength)")

    def act_resize(self):
        width, height = self.chance.choice(((1280, 720), (820, 1180), (1920, 1080), (400, 800), (1024, 600)))
        self.page.resize(width, height)

    def act_speed(self):
        self.send(do="speed", factor=self.chance.choice((0.01, 0.1, 0.5, 1, 1, 1, 2, 10)))


def visit(program, seconds, seed, say):
    """Descriptions of all failures."""
    faults = []
    lab = Program(program)
    with tempfile.TemporaryDirectory() as folder, Browser(width=1280, height=720, scale=0.25) as page:
        page.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=folder)
        page.open(lab.url)
        page.evaluate("window.isSamePage = true; twinarm.page.live.interval = 150")
        user = RandomUser(page, random.Random(seed), say)
        first, most = page.heap(), 0
        begin = reported_at = time.monotonic()
        while time.monotonic() - begin < seconds:
            user.one()
            if time.monotonic() - reported_at > 20:
                reported_at = time.monotonic()
                now = page.heap()
                most = max(most, now)
                say(f"{reported_at - begin:4.0f} s of {seconds:.0f}: {sum(user.done.values())} acts, "
                    f"heap {now / 1e6:.0f} MB, frames {page.evaluate('twinarm.page.link.received')}")
        faults += still_there(page, user)
        last = page.heap()
        most = max(most, last)
        if most - first > HEAP:
            faults.append(f"the page's memory grew from {first / 1e6:.0f} to {most / 1e6:.0f} MB")
        logged = [error for error in page.errors if not any(words in error for words in REFUSED)]
        faults += [f"console: {error}" for error in logged[:5]]
        say(f"{sum(user.done.values())} acts: " +
            ", ".join(f"{name.replace('_', ' ')} {count}" for name, count in user.done.items()))
        say(f"heap {first / 1e6:.1f} MB at first, {last / 1e6:.1f} at last, {most / 1e6:.1f} at most")
    code, words = lab.end()
    if code != 0:
        faults.append(f"the lab ended with {code}: {words[-500:]}")
    return faults


def still_there(page, user):
    """The page has not reloaded and draws new frames."""
    if not page.evaluate("window.isSamePage === true"):
        return ["the page was reloaded"]
    page.wait_for("twinarm.page.link.open")
    user.send(do="scene", name="pendulum")
    page.wait_for(f"{STATE}.name === 'pendulum' && twinarm.page.frame?.scene === twinarm.page.scene.scene")
    user.send(do="speed", factor=1)
    user.send(do="play", on=True)
    page.wait_for(f"{STATE}.playing")
    time_then, pictures = page.evaluate("[twinarm.page.frame.time, twinarm.page.pace.pictures]")
    try:  # slow for a large page on a slow machine
        page.wait_for(f"twinarm.page.frame.time > {time_then} + 0.5 && twinarm.page.pace.pictures > {pictures} + 2")
    except TimeoutError as late:
        return [f"no new frames, or they are not drawn: {late}"]
    return []


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=str(ROOT / "build/release/twinarm"))
    parser.add_argument("--minutes", type=float, default=10)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    if not pathlib.Path(given.program).exists():
        parser.error(f"{given.program} does not exist: scripts/build release twinarm")
    if reason := why_no_page(given.program):
        print(f"skipped: {reason}")
        return SKIPPED
    faults = visit(given.program, 60 * given.minutes, given.seed, lambda words: print(words, flush=True))
    for fault in faults:
        print(f"failure: {fault}")
    print(f"seed {given.seed}: {'passed' if not faults else f'{len(faults)} failures'}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
