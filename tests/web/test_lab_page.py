"""The lab's page in a browser: input, parameters, time, files.

    test_lab_page.py PATH/TO/twinarm [FOLDER_FOR_PICTURES]
"""
import csv
import json
import time

from lab_case import PARAMETER, STATE, Lab, LabCase, Program, main
from program import data, twinarm
from waiting import wait_for

ROD = data("rod.urdf")

# Visible texts with less contrast than WCAG's 4.5 (large ones: 3), without disabled controls.
FAINT = """(() => {
  const parts = text => (text.match(/[\\d.]+/g) ?? [0, 0, 0, 0]).map((part, i) =>
    part * (text.startsWith('color(') && i < 3 ? 255 : 1));  // color(srgb 0.5 ..) of a mixture
  const lum = rgb => rgb.map(v => v / 255).map(v => v <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4)
    .reduce((sum, v, i) => sum + v * [.2126, .7152, .0722][i], 0);
  const ground = node => {
    for (const layers = []; ; node = node.parentElement) {
      const [r, g, b, a = 1] = node ? parts(getComputedStyle(node).backgroundColor) : [255, 255, 255];
      if (a < 1) { if (a > 0) layers.unshift([r, g, b, a]); continue; }
      return layers.reduce((below, [r, g, b, a]) => [r, g, b].map((v, i) => a * v + (1 - a) * below[i]), [r, g, b]);
    }
  };
  const faint = new Set();
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let text; (text = walker.nextNode()); ) {
    const at = text.parentElement;
    if (!text.data.trim() || !at.checkVisibility({visibilityProperty: true})) continue;
    if (at.closest(':disabled, svg, script')) continue;
    if (document.querySelector('dialog:modal') && !at.closest('dialog')) continue;
    const style = getComputedStyle(at), size = parseFloat(style.fontSize);
    const isLarge = size >= 24 || (size >= 18.66 && style.fontWeight >= 700);
    let shown = 1;
    for (let n = at; n; n = n.parentElement) shown *= getComputedStyle(n).opacity;
    const below = ground(at), [r, g, b, a = 1] = parts(style.color);
    const ink = [r, g, b].map((v, i) => a * shown * v + (1 - a * shown) * below[i]);
    const [low, high] = [lum(ink), lum(below)].sort((x, y) => x - y);
    const contrast = (high + .05) / (low + .05);
    if (contrast < (isLarge ? 3 : 4.5))
      faint.add(`${text.data.trim().slice(0, 30)} ${contrast.toFixed(2)} ${at.className}`);
  }
  return [...faint];
})()"""


class LabPage(LabCase):
    def test_a_page_that_was_busy_keeps_its_connection(self):
        self.until("twinarm.page.link.open && twinarm.page.frame")
        self.value("""(({link}) => {
            window.socket = link.socket;
            const end = performance.now() + 3000;
            while (performance.now() < end) link.heard = -1e4; })(twinarm.page)""")
        self.page.frames(20)
        self.assertTrue(self.value("socket === twinarm.page.link.socket && socket.readyState === WebSocket.OPEN"))

    def test_a_connection_that_has_gone_silent_is_opened_anew(self):
        link = "twinarm.page.link"
        self.until(f"{link}.open && {STATE}.playing")
        self.value(f"window.silent = {link}.socket; silent.onmessage = null")
        self.until(f"{link}.open && {link}.socket !== silent")
        before = self.value("twinarm.page.frame.time")
        self.until(f"twinarm.page.frame.time > {before} + 0.2 || twinarm.page.frame.time < {before}")

    def test_options_set_parameters_and_overlays_from_the_start(self):
        def shows(path):
            return self.value(f"{STATE}.parameters.find(p => p.path === '{path}').value")

        lab = Program(self.program, "six_integrators", "--set", "step=0.05", "--show", "energy,trails")
        self.addCleanup(lab.end)
        self.page.open(lab.url)
        self.until(f"{STATE}?.parameters.some(p => p.path === 'step' && Number(p.value) === 0.05)")
        self.assertEqual(self.value("[...twinarm.page.layers].join()"), "energy,trails")
        self.assertNotIn("set=", self.value("location.search"))
        self.page.open(f"{lab.url.split('&')[0]}&scene=pendulum&set=step=0.04")
        self.until(f"{STATE}?.parameters.some(p => p.path === 'step' && Number(p.value) === 0.04)")
        self.until("twinarm.page.scene.file === 'pendulum.toml' && twinarm.page.frame?.time < 1000")
        self.assertEqual(float(shows("step")), 0.04)

    def test_robot_follows_a_dragged_end_effector(self):
        self.until("document.querySelector('h1').textContent.includes('ten obstacles')")
        self.picture("start")
        before = self.channel("q/joint1")
        end = self.drag_tip(-90, 20)
        self.until("twinarm.page.state.input.source === 'drag'")
        wait_for(lambda: abs(self.channel("q/joint1") - before) > 0.2, "the robot follows by 0.2 rad")
        self.picture("dragged")
        self.assertAlmostEqual(self.channel("q/joint1"), self.channel("target/joint1"), delta=0.5)
        self.mouse("mouseReleased", end)

    def restart(self):
        # The page looks, as this process may look too late on a busy machine.
        self.value("""(() => {
            const {page} = twinarm, timer = setInterval(() => {
              if (page.state.time >= 0.5 || !page.state.playing || page.frame.time >= 0.5) return;
              clearInterval(timer);
              window.hasRestarted = true;
            }, 5);
            window.hasRestarted = false;
            page.send({do: 'reset'});
          })()""")
        self.until("window.hasRestarted")

    def target(self):
        return [self.channel(f"target/joint{n}") for n in (1, 2)]

    def drag(self, right, down):
        """How far the driven joints of the target move within half a second [rad]."""
        before = self.target()
        end = self.drag_tip(right, down)
        time = self.value(f"{STATE}.time")
        self.until(f"{STATE}.time > {time} + 0.5")
        self.mouse("mouseReleased", end)
        return [now - then for now, then in zip(self.target(), before)]

    def test_the_end_effector_follows_the_pointer_in_every_direction_from_every_camera(self):
        for view in ("fit", "front", "top"):
            self.click(view)
            for right, down in ((70, 0), (0, 70), (-70, 0), (0, -70)):
                self.restart()
                with self.subTest(view=view, right=right, down=down):
                    self.assertGreater(max(map(abs, self.drag(right, down))), 0.1)

    def test_a_mechanism_stays_in_view_above_the_card_for_a_revolution(self):
        outside = """(({scene, frame, live}) => { const {width, y} = live.host.getBoundingClientRect();
            const foot = document.querySelector('.look').getBoundingClientRect().top - y;
            return scene.bodies.flatMap(({name, moves}, i) => {
              const at = moves && live.stage.project(...frame.link.subarray(7 * i, 7 * i + 3));
              return !at || at.x > 0 && at.x < width && at.y > 0 && at.y < foot ? [] : [`${name} ${at.x} ${at.y}`];
            }); })(twinarm.page)"""
        for name, period in (("four_bar", 1.95), ("slider_crank", 1), ("box_stack", 0.1)):
            self.value(f"twinarm.page.send({{do: 'scene', name: {name!r}}})")
            self.until(f"{STATE}.name === {name!r} && twinarm.page.frame?.scene === twinarm.page.scene.scene")
            self.until("document.querySelector('.look').checkVisibility()")
            with self.subTest(name):
                while self.value(f"{STATE}.time") < period:
                    self.assertEqual(self.value(outside), [])

    def test_a_restart_also_restarts_the_hand(self):
        start = self.target()
        first = self.drag(-90, 0)
        self.restart()
        self.assertEqual(self.target(), start)
        for now, then in zip(self.drag(-90, 0), first):
            self.assertAlmostEqual(now, then, delta=0.15 * max(map(abs, first)))

    def test_every_remedy_is_stable_after_the_end_effector_was_dragged(self):
        self.drag(-90, 20)
        explicit = "'coupling[0].discretization=explicit'"
        self.value(f"twinarm.page.send({{do: 'set', changes: [{explicit}]}})")
        self.until(f"{STATE}.changes.length === 1")
        for index in range(3):
            self.value(f"twinarm.page.send({{do: 'set', changes: ['step=0.001', {explicit}, "
                       "'coupling[0].stiffness=3e7']})")
            self.until(f"{STATE}.changes.includes('coupling[0].stiffness=3e7')")
            # At rest it might stay.
            self.value("twinarm.page.send({do: 'drag_body', body: 3, point: [0, 0, 0], goal: [1, 1, 1]})")
            self.until(f"{STATE}.failure && !{STATE}.failure.trying")
            stopped = self.value(f"{STATE}.failure.time")
            remedies = self.value(f"{STATE}.failure.remedies.map(r => r.words)")
            remedy = remedies[min(index, len(remedies) - 1)]
            with self.subTest(remedy):
                self.click(remedy)
                self.until(f"{STATE}.branch && ({STATE}.time > {stopped} + 1 || {STATE}.failure && "
                           f"{STATE}.branch.number > {index})")
                self.assertIsNone(self.value(f"{STATE}.failure"))

    def test_inspector_follows_the_selection_and_overlays_toggle(self):
        self.value("twinarm.page.select(2)")
        self.click("Inspector")
        self.until("document.querySelector('aside').textContent.includes('arm1')")
        self.until("document.querySelectorAll('aside math').length > 0")
        self.picture("inspector")
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
        self.page.open(self.url)  # a reloaded page has the same overlays
        self.until(f"{shown}.includes('frames')")

    def test_beyond_the_stability_limit_the_run_diverges_and_the_first_remedy_is_stable(self):
        self.until(f"{STATE}.time > 0.5")
        self.value("twinarm.page.send({do: 'set', changes: ['coupling[0].discretization=explicit']})")
        self.until(f"{STATE}.changes.length === 1")
        self.until(f"{STATE}.parameters.find(k => k.path === 'coupling[0].stiffness').limit?.value > 0")
        limit = self.value(f"{STATE}.parameters.find(k => k.path === 'coupling[0].stiffness').limit.value")
        self.type_into(PARAMETER % "stiffness", f"{0.9 * limit:.3g}")
        self.until("document.querySelector('.predicted .near')")
        self.assertIsNone(self.value(f"{STATE}.failure"))
        self.picture("amber")
        self.type_into(PARAMETER % "stiffness", f"{20 * limit:.3g}")
        self.until(f"{STATE}.changes.length === 2")
        self.value("twinarm.page.send({do: 'drag_body', body: 3, point: [0, 0, 0], goal: [1, 1, 1]})")
        self.until(f"{STATE}.failure")
        self.until("!document.querySelector('.post-mortem').hidden")
        self.until(f"!{STATE}.failure.trying")
        self.picture("post_mortem")
        self.click(self.value(f"{STATE}.failure.remedies[0].words"))
        self.until(f"{STATE}.branch && !{STATE}.failure && {STATE}.playing")
        then = self.value(f"{STATE}.time")
        self.until(f"{STATE}.time > {then} + 1")
        self.assertIsNone(self.value(f"{STATE}.failure"))

    def test_seek_and_branch(self):
        self.until(f"{STATE}.time > 3")
        bar = "document.querySelector('input[type=range][title^=instant], input[type=range][aria-label^=instant]')"
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

    def until_message(self, name, words):
        """Until the answer to a dropped file is shown, not only that it is on its way."""
        message = "document.querySelector('.gallery .message').innerText"
        self.until(f"{message}.includes({name!r}) && {message}.includes({words!r}) "
                   f"&& !{message}.startsWith('Opening')")

    def test_dropped_robots_open_and_other_files_are_rejected(self):
        for name in ("fresh.urdf", "arm.xml"):
            scene = self.value("twinarm.page.scene.scene")
            self.page.drop(name, ROD)
            self.until(f"twinarm.page.scene.scene > {scene}")
            self.assertEqual(self.value("twinarm.page.scene.file"), name)
            self.until("twinarm.page.frame?.scene === twinarm.page.scene.scene")
        self.picture("dropped")
        for name, text, words in (("bad.urdf", ROD.replace('type="continuous"', 'type="bendy"'), "bendy"),
                                  ("ant.xml", '<mujoco model="ant"/>', "MJCF"),
                                  ("half.xacro", ROD.replace('value="1"', 'value="${m}"'), "xacro"),
                                  ("photo.heic", "junk", ".urdf"), ("a.stl", "solid", "is stored")):
            self.page.drop(name, text)
            self.until_message(name, words)
        self.picture("not_opened")
        self.assertEqual(self.value("twinarm.page.scene.file"), "arm.xml")
        self.page.errors.clear()  # the browser's message for HTTP 422

    def test_message_is_about_the_last_drop_however_late_earlier_answers_are(self):
        self.value("(get => { let wait = 500; window.fetch = async (...request) => {"
                   " const late = wait; wait = 0; const answer = await get(...request);"
                   " await new Promise(done => setTimeout(done, late)); return answer; }; })(window.fetch), 0")
        self.page.drop("first.heic", "junk")
        self.page.drop("last.heic", "junk")
        self.until_message("last.heic", ".urdf")
        time.sleep(1)  # longer than the first answer waits
        self.assertIn("last.heic", self.value("document.querySelector('.gallery .message').innerText"))
        self.page.errors.clear()  # the browser's message for HTTP 422

    def test_restore_resets_changes_of_all_clients_and_the_run_continues(self):
        first = self.value(f"{STATE}.parameters.map(k => [k.path, k.value])")
        self.value("twinarm.page.send({do: 'set', changes: ['coupling[0].stiffness=321', "
                   "'step=0.0005', 'coupling[0].discretization=explicit']})")
        self.until(f"{STATE}.changes.length === 3")
        self.page.open(self.url)  # a new client
        self.until(f"{STATE} && {STATE}.time > 1")
        self.until("document.querySelectorAll('.parameter.changed').length === 3")
        self.picture("changed")
        scene, time_then = self.value(f"[twinarm.page.scene.scene, {STATE}.time]")
        self.click("Reset")
        self.until(f"{STATE}.changes.length === 0")
        self.assertEqual(self.value(f"{STATE}.parameters.map(k => [k.path, k.value])"), first)
        self.until("document.querySelectorAll('.parameter.changed').length === 0")
        self.assertEqual(self.value("twinarm.page.scene.scene"), scene)
        self.assertGreater(self.value(f"{STATE}.time"), time_then)

    def test_csv_has_the_values_of_the_recording(self):
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
        exported = json.loads(twinarm("export", recording, "--json").stdout)
        names = [column["name"] for column in exported["columns"]]
        frames = {round(f["t"], 9): dict(zip(names, f["values"])) for f in exported["frames"]}
        column = next(i for i, name in enumerate(head) if name.startswith("q/joint1"))
        both = 0
        for row in rows:
            frame = frames.get(round(float(row[0]), 9))
            if frame:
                both += 1
                self.assertEqual(float(row[column]), frame["q/joint1"])
        self.assertGreater(both, 10)
        self.assertGreater(len(lab.get("/share").body), 100_000)

    def test_plots_of_previous_scenes_are_freed(self):
        self.click("Plots")
        names = ("pendulum", "gyroscope")

        def open_scenes(times):
            for name in times * names:
                self.value(f"twinarm.page.send({json.dumps({'do': 'scene', 'name': name})})")
                self.until(f"{STATE}.name === {name!r} && twinarm.page.frame?.scene === twinarm.page.scene.scene")
                self.until("document.querySelectorAll('.plots canvas').length > 2")
                self.page.frames(12)
            return self.page.heap()

        first = open_scenes(2)
        self.assertLess(open_scenes(5) - first, 1.5e6)  # a leak of the charts: 0.3 MB per scene

    def test_text_contrast(self):
        for dark in (False, True):
            self.value(f"twinarm.page.theme.set({json.dumps(dark)})")
            for tab in ("Parameters", "Plots", "Energy", "Inspector"):
                self.value(f"twinarm.page.showTab({tab!r}); twinarm.page.select(3)")
                self.page.frames(30)
                self.assertEqual(self.value(FAINT), [], f"{tab}, dark: {dark}")
            self.click("Scenes")
            self.assertEqual(self.value(FAINT), [], f"gallery, dark: {dark}")
            self.page.press("Escape")

    def test_dark_theme_and_tablet_layout(self):
        self.value("[...document.querySelectorAll('header button')].find(b => b.title.startsWith('light')).click()")
        self.until("document.documentElement.dataset.theme === 'dark'")
        self.picture("dark")
        self.page.resize(820, 1180, mobile=True)
        self.page.frames(5)
        self.picture("tablet")
        self.assertLessEqual(self.value("document.documentElement.scrollWidth"), 820)


if __name__ == "__main__":
    main()
