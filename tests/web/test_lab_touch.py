"""The lab with touch input, in a browser with an emulated touch screen."""
import math
import time

from lab_case import LabCase, main

CAMERA = """(({camera, controls: {target}}) => { const d = camera.position.clone().sub(target);
  return [Math.atan2(d.y, d.x), d.z / d.length(), d.length()]; })(twinarm.page.live.stage)"""
CANVAS = "document.querySelector('.stage canvas')"
BODY = """(() => {
  const {x, y, width, height} = %s.getBoundingClientRect(), {drag} = twinarm.page;
  for (let v = .1; v < .9; v += .01) for (let u = .2; u < .8; u += .01) {
    const at = {x: u * width, y: v * height};
    const found = drag.find(drag.view(), at);
    if (found.kind === 'body' && twinarm.page.scene.bodies[found.hit?.body]?.moves &&
        document.elementFromPoint(x + at.x, y + at.y) instanceof HTMLCanvasElement)
      return [x + at.x, y + at.y];
  }
  return null; })()""" % CANVAS
VIEW = """(() => {
  const {x, y, width, height} = %s.getBoundingClientRect(), {live, state} = twinarm.page;
  const over = document.elementFromPoint(x + width / 2, y + height / 2)?.outerHTML.slice(0, 200);
  return JSON.stringify({x, y, width, height, over, camera: live.stage.camera.position,
    geometries: live.stage.painter.geometries.length, time: state.time}); })()""" % CANVAS
SMALL = """[...document.querySelectorAll('button, select, input, summary, a, label')].flatMap(at => {
  if (!at.checkVisibility({visibilityProperty: true}) || at.closest('svg, [aria-hidden=true]')) return [];
  if (document.querySelector('dialog:modal') && !at.closest('dialog')) return [];
  if (at instanceof HTMLLabelElement && !at.querySelector('input')) return [];
  const target = (at.type === 'checkbox' && at.closest('label')) || at;
  const {width, height} = target.getBoundingClientRect();
  if (width === 0 || (width >= 43.9 && height >= 43.9)) return [];
  return [`${at.tagName} ${at.className} "${(at.textContent || at.title).slice(0, 20)}" ` +
    `${width.toFixed(0)} x ${height.toFixed(0)}`]; })"""


class Touch(LabCase):
    def setUp(self):
        super().setUp()
        self.page.resize(820, 1180, mobile=True)
        self.page.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)
        self.page.open(self.url)
        self.page.frames(5)

    def center(self):
        return self.value("(r => [r.x + r.width / 2, r.y + r.height / 2])(%s.getBoundingClientRect())" % CANVAS)

    def body(self):
        """A point of the view on a moving body, away from the ring."""
        deadline = time.monotonic() + self.page.timeout
        while (at := self.value(BODY)) is None:
            if time.monotonic() > deadline:
                self.fail(f"no moving body in the view: {self.value(VIEW)}")
            self.page.frames(2)
        return at

    def pinch(self, first, second, early=None):
        """Increases the distance of two fingers by 50 %; `early`: the first moves there before the second touches."""
        now = time.time()
        if early:
            self.page.touch("touchStart", [first], now - 0.15)
            self.page.touch("touchMove", [early], now - 0.05)
            first = early
        self.page.touch("touchStart", [first, second], now)
        middle = [(a + b) / 2 for a, b in zip(first, second)]
        for i in range(1, 9):
            part = 1 + i / 16
            self.page.touch("touchMove", [[m + part * (p - m) for m, p in zip(middle, point)]
                                          for point in (first, second)])
            self.page.frames(1)
        self.page.touch("touchEnd", [])
        self.page.frames(2)

    def test_two_fingers_zoom_without_rotation_or_spring_force(self):
        x, y = self.center()
        on_body = self.body()
        for name, first, second, early in (
                ("on the floor", (60, y + 60), (160, y + 100), None),
                ("on a body", on_body, (on_body[0] + 90, on_body[1] + 40), None),
                ("one after the other", (60, y + 60), (180, y + 100), (84, y + 48)),
                ("one after the other, on a body", on_body, (on_body[0] + 90, on_body[1] + 40),
                 (on_body[0] - 20, on_body[1] - 16))):
            with self.subTest(name):
                around, rise, far = self.value(CAMERA)
                selected = self.value("twinarm.page.selected")
                self.pinch(first, second, early)
                now = self.value(CAMERA)
                self.assertAlmostEqual(now[0], around, places=6)
                self.assertAlmostEqual(now[1], rise, places=6)
                self.assertLess(now[2], 0.8 * far)
                self.assertEqual(self.value("twinarm.page.selected"), selected)
                self.assertIsNone(self.value("twinarm.page.drag.held"))
                self.assertTrue(self.value("twinarm.page.live.stage.controls.enabled"))
                self.value("twinarm.page.live.stage.look('start')")

    def test_one_finger_rotates_the_view_and_applies_a_spring_force(self):
        _, y = self.center()
        around = self.value(CAMERA)[0]
        self.page.touch("touchStart", [(60, y)])
        for i in range(1, 9):
            self.page.touch("touchMove", [(60 + 10 * i, y)])
        self.page.touch("touchEnd", [])
        self.assertGreater(abs(math.remainder(self.value(CAMERA)[0] - around, 2 * math.pi)), 0.05)
        self.value("twinarm.page.live.stage.look('start')")
        self.page.frames(2)
        at = self.body()
        self.page.touch("touchStart", [at])
        for i in range(1, 9):
            self.page.touch("touchMove", [(at[0] + 5 * i, at[1])])
            self.page.frames(1)
        self.until("twinarm.page.drag.held?.kind === 'spring'")
        self.page.touch("touchEnd", [])
        self.page.frames(2)
        self.assertIsNone(self.value("twinarm.page.drag.held"))

    def test_touch_targets_have_44_pixels(self):
        self.assertTrue(self.value("matchMedia('(pointer: coarse)').matches"))
        self.value("twinarm.page.send({do: 'set', changes: ['coupling[0].discretization=explicit']})")
        for tab in ("Parameters", "Plots", "Inspector", "Energy"):
            self.value(f"twinarm.page.showTab({tab!r}); twinarm.page.overlays.fold(false)")
            self.page.frames(20)
            self.assertEqual(self.value(SMALL), [], tab)
            self.picture(f"touch_{tab.lower()}")
        for opens in ("e", "?", "b"):
            self.page.press(opens)
            self.page.frames(3)
            self.assertEqual(self.value(SMALL), [], opens)
            self.picture(f"touch_dialog_{opens.replace('?', 'keys')}")
            self.page.press("Escape")


if __name__ == "__main__":
    main()
