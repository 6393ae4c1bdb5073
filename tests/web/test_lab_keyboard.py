"""The lab by keyboard: each tab stop is visible and has an accessible name; time, branch, parameters,
overlays, input, scenes, files and inspector; dialogs restore the focus."""
from lab_case import STATE, LabCase, main

AT = "document.activeElement"
HAS_FOCUS = f"{AT} !== null && {AT} !== document.body"
MAX_STOPS = 160


class Keyboard(LabCase):
    def keys(self, *keys):
        for key in keys:
            self.page.press(key)

    def type(self, text):
        for letter in text:
            self.page.press(letter)

    def tab_to(self, selector, shift=False):
        """Presses tab until the focus is there."""
        for _ in range(MAX_STOPS):
            if self.value(f"{AT}.matches({selector!r})"):
                return
            self.page.press("Tab", shift)
        self.fail(f"the tab key does not come to {selector}")

    def at_focus(self):
        """Accessible role and name; has a focus ring; is inside the window; index in the document."""
        found = self.page.call("Runtime.evaluate", expression=AT)["result"]["objectId"]
        tree = self.page.call("Accessibility.getPartialAXTree", objectId=found, fetchRelatives=False)
        node = tree["nodes"][0]
        seen, inside, number = self.value("""(at => {
            const style = getComputedStyle(at), box = at.getBoundingClientRect();
            const ring = style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) >= 2;
            const all = [...document.querySelectorAll('*')];
            return [ring, box.width > 0 && box.right > 0 && box.bottom > 0 && box.left < innerWidth &&
                    box.top < innerHeight, all.indexOf(at)]; })(%s)""" % AT)
        text = {key: node.get(key, {}).get("value", "") for key in ("role", "name")}
        return text["role"], text["name"], seen, inside, number

    def test_each_tab_stop_is_visible_and_has_a_name(self):
        self.page.call("Accessibility.enable")
        for tab in ("Parameters", "Plots", "Inspector", "Energy"):
            with self.subTest(tab):
                self.value(f"{AT}.blur(); twinarm.page.showTab({tab!r}); twinarm.page.send({{do: 'play', on: false}})")
                self.page.frames(30)
                stops = []
                for _ in range(MAX_STOPS):
                    self.page.press("Tab")
                    if not self.value(HAS_FOCUS) or (stops and self.at_focus()[4] == stops[0][4]):
                        break
                    stops.append(self.at_focus())
                self.assertGreater(len(stops), 15)
                self.assertLess(len(stops), MAX_STOPS)
                for role, name, seen, inside, _ in stops:
                    self.assertTrue(name.strip(), f"a {role} without a name")
                    self.assertNotIn(role, ("generic", "none"), name)
                    self.assertTrue(seen and inside, f"{role} '{name}' does not show the focus")
                numbers = [stop[4] for stop in stops]
                self.assertEqual(numbers, sorted(numbers))
                names = [stop[:2] for stop in stops if stop[0] != "radio"]  # of named groups
                if tab == "Parameters":  # of several couplings
                    self.assertEqual(sorted(set(names)), sorted(names))

    def test_seek_branch_and_dialogs_restore_the_focus(self):
        self.until(f"{STATE}.time > 1.5")
        self.keys(" ")
        self.until(f"!{STATE}.playing")
        for _ in range(5):
            self.page.press("ArrowLeft", shift=True)
        self.until(f"{STATE}.at !== null && twinarm.page.frame.lookedBack")
        self.tab_to(".transport .row button:not(.play, [disabled])")
        self.value("window.before = document.activeElement")
        self.keys("b")
        self.until("document.querySelector('dialog.branch[open]')?.contains(document.activeElement)")
        self.keys("Escape")
        self.until("!document.querySelector('dialog[open]')")
        self.assertTrue(self.value("before === document.activeElement"))
        self.keys("b")
        self.tab_to("dialog.branch button[type=submit]")
        self.keys("Enter")
        self.until(f"{STATE}.branch !== null && {STATE}.at === null && {STATE}.playing")
        for key, dialog in (("?", "dialog.help"), ("e", "dialog.gallery")):
            self.keys(key)
            self.until(f"document.querySelector('{dialog}[open]')?.contains(document.activeElement)")
            self.keys("Escape")
            self.until("!document.querySelector('dialog[open]')")
            self.assertTrue(self.value("before === document.activeElement"), dialog)

    def test_parameters_presets_and_tabs(self):
        self.tab_to("[role=tab]")
        self.keys("ArrowRight")
        self.until(f"{AT}.textContent === 'Plots' && {AT}.getAttribute('aria-selected') === 'true'")
        self.keys("Home")
        self.until(f"{AT}.textContent === 'Parameters'")
        self.tab_to("#parameter-coupling-0--stiffness")
        self.type("777")
        self.keys("Enter")
        self.until(f"{STATE}.parameters.find(k => k.path === 'coupling[0].stiffness').value === 777")
        self.page.press("Tab", shift=True)
        self.assertEqual(self.value(f"{AT}.type"), "range")
        self.keys("ArrowRight")
        self.until(f"{STATE}.parameters.find(k => k.path === 'coupling[0].stiffness').value === 855")
        self.tab_to(".parameters > button")
        self.keys("Enter")
        self.until(f"{STATE}.changes.length === 0")
        self.tab_to(".presets button:nth-child(3)", shift=True)
        self.keys("Enter")
        self.until(f"{STATE}.name === 'E3'")

    def test_space_plays_and_pauses_after_a_click_on_a_preset(self):
        button = "[...document.querySelectorAll('.presets button')].find(b => b.textContent.includes('E3'))"
        self.value(f"{button}.scrollIntoView()")
        at = self.value(f"(r => [r.x + r.width / 2, r.y + r.height / 2])({button}.getBoundingClientRect())")
        self.mouse("mousePressed", at)
        self.mouse("mouseReleased", at)
        self.until(f"{STATE}.name === 'E3' && {STATE}.playing && {STATE}.time > 0.3")
        before = self.value(f"{STATE}.time")
        self.keys(" ")
        self.until(f"!{STATE}.playing")
        self.page.frames(20)
        self.assertGreaterEqual(self.value(f"{STATE}.time"), before)  # not from the start again

    def test_typing_continues_when_the_rows_of_parameters_are_replaced(self):
        self.tab_to("#parameter-coupling-0--stiffness")
        self.type("3e")
        self.value("window.before = document.activeElement; twinarm.page.set.parameters.build("
                   f"{STATE}.parameters)")
        self.assertFalse(self.value(f"before === {AT}"))
        self.type("3")
        self.keys("Enter")
        self.until(f"{STATE}.parameters.find(k => k.path === 'coupling[0].stiffness').value === 3000")

    def test_tooltips_of_parameters_are_sentences(self):
        titles = self.value("[...document.querySelectorAll('.parameter [title]')].map(at => at.title)")
        self.assertGreater(len(titles), 10)
        self.assertEqual([title for title in titles if ".." in title], [])

    def test_the_theme_follows_the_system_until_one_is_chosen(self):
        theme = "document.documentElement.dataset.theme"
        try:
            for dark in (True, False, True):
                self.page.prefer(dark)
                self.until(f"{theme} === '{'dark' if dark else 'light'}'")
            self.keys("t")
            self.until(f"{theme} === 'light'")
            self.page.prefer(False)
            self.page.prefer(True)
            self.page.frames(5)
            self.assertEqual(self.value(theme), "light")
        finally:
            self.page.prefer(False)

    def test_overlays_files_and_scenes_open_and_restore_the_focus(self):
        self.keys("o")
        self.tab_to(".overlays [data-layer=frames]")
        self.keys(" ")
        self.until("twinarm.page.overlays.names.includes('frames')")
        self.keys("Escape")
        self.until("document.querySelector('.overlays .switches').hidden")
        self.assertTrue(self.value(f"{AT}.matches('.overlays > button')"))
        self.tab_to(".transport .menu summary")
        self.keys("Enter")
        self.until("document.querySelector('.transport .menu').open")
        self.tab_to(".transport .menu a[href='/save']")
        self.keys("Escape")
        self.until("!document.querySelector('.transport .menu').open")
        self.assertTrue(self.value(f"{AT}.matches('.menu summary')"))
        self.tab_to(".transport .menu summary")
        self.keys("Enter")
        self.tab_to(".transport .menu a[href='/save']")
        self.keys("Enter")
        self.assertGreater(self.downloaded(".twinrec").stat().st_size, 1000)
        self.keys("e")
        self.tab_to("dialog.gallery .card")
        self.keys("ArrowRight", "ArrowDown", "ArrowUp")
        chosen = self.value(f"{AT}.dataset.scene")
        self.keys("Enter")
        self.until(f"{STATE}.name === {chosen!r}")
        self.assertFalse(self.value("document.querySelector('dialog.gallery').open"))

    def test_end_effector_joints_spring_and_inspector(self):
        self.keys("j")
        self.until(f"{AT}.matches('.grip')")
        self.keys("ArrowUp", "ArrowUp", "ArrowUp")
        self.until(f"{STATE}.input.source === 'joints'")
        self.keys("h", "ArrowRight", "ArrowUp", "PageUp")
        self.until(f"{STATE}.input.source === 'drag'")
        self.keys("Escape", "m")
        self.until("twinarm.page.selected !== null")
        self.keys("x", "ArrowUp", "ArrowUp")
        self.until("twinarm.page.keys.spring !== null")
        self.keys("x", " ", "i")
        self.until("document.querySelector('.inspector').checkVisibility() && "
                   "document.querySelector('.inspector .place').textContent.startsWith('step')")
        before = self.value("document.querySelector('.inspector .place').textContent")
        self.keys(".")
        self.until(f"document.querySelector('.inspector .place').textContent !== {before!r}")
        self.keys("Escape")
        self.assertIsNone(self.value("twinarm.page.selected"))


if __name__ == "__main__":
    main()
