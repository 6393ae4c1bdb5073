"""What a person does with the lab's page, by mouse or by touch: each action is one gesture on something that is
visible, not covered, and at least 24 pixels large. Only `See` and `Remember` read the page."""
import dataclasses
import json

FIND = """((name, scroll) => {
  const host = document.querySelector('dialog:modal') ?? document;
  const seen = [...host.querySelectorAll('button, summary, a, label, select, input')].filter(at =>
    at.checkVisibility({visibilityProperty: true}) && !at.closest('svg, [aria-hidden=true]'));
  const words = at => [at.textContent.trim(), at.getAttribute('aria-label') ?? '', at.title, at.value ?? ''];
  const at = seen.find(at => words(at).includes(name)) ?? seen.find(at => words(at).some(w => w.startsWith(name)));
  if (!at || at.disabled) return null;
  const before = at.getBoundingClientRect().y;
  if (scroll) at.scrollIntoView({block: 'nearest'});
  const {x, y, width, height} = at.getBoundingClientRect();
  const middle = [x + width / 2, y + height / 2], over = document.elementFromPoint(...middle);
  const isFree = over && (at.contains(over) || over.closest('label')?.contains(at) || over.closest('label') === at);
  return {middle, height, width, scrolled: Math.abs(before - y) > 1,
          cover: isFree ? null : over?.outerHTML.slice(0, 120) ?? 'the edge of the window'}; })"""

# Visible controls whose middle is covered, or outside the window where nothing scrolls, or that are too small.
UNREACHABLE = """(part => [...part.querySelectorAll('button, summary, a, select, input')].flatMap(at => {
  if (!at.checkVisibility({visibilityProperty: true}) || at.closest('svg, [aria-hidden=true]')) return [];
  if (document.querySelector('dialog:modal') && !at.closest('dialog:modal')) return [];
  const target = (at.type === 'checkbox' && at.closest('label')) || at;
  const {x, y, width, height} = target.getBoundingClientRect(), u = x + width / 2, v = y + height / 2;
  const name = `${at.tagName} ${at.ariaLabel ?? at.textContent.slice(0, 30)}`;
  if (width < 23.9 || height < 23.9) return [`${name}: ${width.toFixed(0)} x ${height.toFixed(0)}`];
  let scrolls = false;
  for (let p = target.parentElement; p && !scrolls; p = p.parentElement) {
    const box = p.getBoundingClientRect();
    scrolls = /auto|scroll/.test(getComputedStyle(p).overflowY) &&
      (v < box.top + 1 || v > box.bottom - 1 || u < box.left || u > box.right);
  }
  if (scrolls) return [];
  const over = document.elementFromPoint(u, v);
  return over && (target.contains(over) || over.contains(target) && over.tagName === 'LABEL') ? [] :
    [`${name}: covered by ${over?.outerHTML.slice(0, 60) ?? 'the edge of the window'}`]; }))"""

# Points of the view, found as the eye finds them: a body that moves, and the background.
PIXEL = """(wanted => { const canvas = document.querySelector('.stage canvas'), {drag, scene} = twinarm.page;
  const {x, y, width, height} = canvas.getBoundingClientRect();
  for (const step of [.04, .015]) for (let v = .1; v < .95; v += step) for (let u = .05; u < .95; u += step) {
    const at = {x: u * width, y: v * height};
    if (document.elementFromPoint(x + at.x, y + at.y) !== canvas) continue;
    const {kind, hit} = drag.find(drag.view(), at), body = kind === 'body' && hit && scene.bodies[hit.body];
    const is = wanted === '' ? kind === 'body' && !body :
      body?.moves && (wanted === '*' || body.name.startsWith(wanted));
    if (is) return [x + at.x, y + at.y];
  }
  return null; })"""
RING = "(r => r.width ? [r.x + r.width / 2, r.y + r.height / 2] : null)" \
       "(document.querySelector('button.grip').getBoundingClientRect())"
BACKGROUND = f"{PIXEL}('')"


def body(name="*"):
    return f"{PIXEL}({name!r})"


def along(slider, share):
    """A point of a slider: 0 is its left end; None: its thumb."""
    place = "at.value / at.max" if share is None else share
    return ("(at => { at.scrollIntoView({block: 'nearest'}); const r = at.getBoundingClientRect();"
            f" return [r.x + 8 + {place} * (r.width - 16), r.y + r.height / 2]; }})"
            f"(document.querySelector({json.dumps(slider)}))")


@dataclasses.dataclass
class Click:
    name: str  # text, accessible name or tooltip, or its beginning

    def do(self, user):
        user.tap(user.find(self.name))


@dataclasses.dataclass
class Choose:
    """An entry of a list. The opened list is the browser's, not the page's: only its choice is sent."""
    name: str
    entry: str
    cost = 2

    def do(self, user):
        user.find(self.name)
        user.value("""((name, entry) => { const list = [...document.querySelectorAll('select')].find(at =>
            at.title.startsWith(name) || at.ariaLabel?.startsWith(name));
            list.value = [...list.options].find(o => o.text.startsWith(entry)).value;
            list.dispatchEvent(new Event('change', {bubbles: true})); })(%s, %s)""" %
                   (json.dumps(self.name), json.dumps(self.entry)))


@dataclasses.dataclass
class Drag:
    start: str  # a point of the page
    right: float = 0
    down: float = 0
    end: str | None = None  # instead of (right, down)
    hold: str | None = None  # what is seen before the button or finger is released

    def do(self, user):
        x, y = user.point(self.start)
        to = user.point(self.end) if self.end else (x + self.right, y + self.down)
        user.drag((x, y), to, self.hold)


@dataclasses.dataclass
class Tap:
    at: str

    def do(self, user):
        user.tap(user.point(self.at))


@dataclasses.dataclass
class Key:
    key: str

    def do(self, user):
        user.page.press(self.key)


@dataclasses.dataclass
class Type:
    """Replaces the text of the field that has the focus."""
    text: str

    def do(self, user):
        user.value("document.activeElement.select()")
        user.page.call("Input.insertText", text=self.text)


@dataclasses.dataclass
class See:
    what: str
    cost = 0

    def do(self, user):
        user.page.wait_for(f"!!({self.what})")


@dataclasses.dataclass
class Remember:
    name: str
    what: str
    cost = 0

    def do(self, user):
        user.value(f"(window.seen ??= {{}}).{self.name} = {self.what}")


class User:
    """Acts with a mouse or a finger; counts its actions."""

    def __init__(self, page, by_touch):
        self.page, self.by_touch, self.actions = page, by_touch, 0

    def do(self, actions):
        for action in actions:
            self.actions += getattr(action, "cost", 1)
            action.do(self)

    def value(self, expression):
        return self.page.evaluate(expression)

    def point(self, expression):
        self.page.wait_for(f"!!({expression})")
        return self.value(expression)

    def find(self, name):
        """The middle of a control; scrolling to it is an action."""
        found = f"{FIND}({json.dumps(name)}, false)"
        self.page.wait_for(f"!!({found})")
        found = self.value(f"{FIND}({json.dumps(name)}, true)")
        seen = []
        while len(seen) < 2 or not seen[-1] or seen[-1] != seen[-2]:  # until it stays where it is
            self.page.frames(3)
            again = self.value(f"{FIND}({json.dumps(name)}, false)")
            seen.append(again and again["middle"])
            if len(seen) > 200:
                raise AssertionError(f"{name} does not stay where it is: {seen[-4:]}")
            if again:
                found = again | {"scrolled": found["scrolled"]}
        self.actions += found["scrolled"]
        if found["cover"]:
            raise AssertionError(f"{name} is covered by {found['cover']}")
        if min(found["width"], found["height"]) < 23.9:
            raise AssertionError(f"{name} is {found['width']:.0f} x {found['height']:.0f} pixels")
        return found["middle"]

    def tap(self, at):
        if self.by_touch:
            self.page.touch("touchStart", [at])
            self.page.touch("touchEnd", [])
        else:
            for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
                self.mouse(kind, at)
        self.page.frames(2)

    def mouse(self, kind, at):
        self.page.call("Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button="left", buttons=1, clickCount=1)

    def drag(self, start, end, hold):
        begin, move = ("touchStart", "touchMove") if self.by_touch else ("mousePressed", "mouseMoved")
        act = (lambda kind, at: self.page.touch(kind, [at])) if self.by_touch else self.mouse
        if not self.by_touch:
            act("mouseMoved", start)
        act(begin, start)
        for i in range(1, 9):
            act(move, [a + (b - a) * i / 8 for a, b in zip(start, end)])
            self.page.frames(1)
        if hold:
            self.page.wait_for(f"!!({hold})")
        if self.by_touch:
            self.page.touch("touchEnd", [])
        else:
            act("mouseReleased", end)
        self.page.frames(2)
