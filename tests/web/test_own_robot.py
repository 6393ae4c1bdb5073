"""A robot of one's own in the lab: posed, held by springs, given a floor, saved as a scene.

    test_own_robot.py PATH/TO/twinarm [FOLDER_FOR_PICTURES]
"""
import math

from lab_case import STATE, LabCase, main
from program import data

ROD = data("rod.urdf")


class OwnRobot(LabCase):
    def setUp(self):
        super().setUp()
        self.until("twinarm.page.operator.hasControl")  # others may not give it files
        self.page.drop("mine.urdf", ROD)
        self.until_scene("mine.urdf")

    def until_scene(self, file):
        self.until(f"twinarm.page.scene.file === {file!r} && twinarm.page.frame?.scene === twinarm.page.scene.scene")

    def add(self, label):
        scene = self.value("twinarm.page.scene.scene")
        self.value("document.querySelector('.build summary').click()")
        self.click(label, "document.querySelector('.build')")
        self.until(f"twinarm.page.scene.scene > {scene} && twinarm.page.frame?.scene === twinarm.page.scene.scene")

    def names(self):
        return self.value("twinarm.page.scene.bodies.map(body => body.name)")

    def test_a_start_pose_set_in_pause_is_shown_at_once_and_the_run_begins_there(self):
        self.value("twinarm.page.send({do: 'play', on: false})")
        self.until(f"!{STATE}.playing")
        self.value("document.querySelector('[data-path=\"robot[0].q.hinge\"] input[type=range]').focus()")
        self.page.press("End")
        self.until(f"{STATE}.time === 0 && {STATE}.changes.length === 1 && twinarm.page.frame.time === 0")
        self.assertAlmostEqual(self.channel("q/hinge"), math.pi, places=9)
        self.assertFalse(self.value(f"{STATE}.playing"))

    def test_springs_at_the_joints_let_the_pointer_drag_the_robot(self):
        self.add("Springs at all joints")
        self.until(f"{STATE}.input.source === 'drag' && twinarm.page.scene.tip")
        self.until(f"{STATE}.playing && {STATE}.time > 0.3")
        before = self.channel("q/hinge")
        end = self.drag_tip(-80, -20)
        self.until(f"{STATE}.time > 1.5")
        self.assertGreater(abs(self.channel("q/hinge") - before), 0.1)
        self.mouse("mouseReleased", end)
        self.picture("own_robot")

    def test_floor_and_box_are_added_and_the_selected_one_is_removed(self):
        self.add("Floor")
        self.add("Box")
        self.assertIn("box", self.names())
        self.value(f"twinarm.page.select({self.names().index('box')})")
        self.add("Remove box")
        self.assertNotIn("box", self.names())

    def test_the_saved_scene_names_the_robots_file_and_has_what_was_added(self):
        self.value("twinarm.page.send({do: 'edit', what: 'link-spring', name: 'rod'})")
        self.until(f"{STATE}.input.source === 'drag'")
        text = self.value("fetch('/scene').then(answer => answer.text())")
        for part in ('model = "mine.urdf"', "[[coupling]]", 'link = "rod"'):
            self.assertIn(part, text)

    def test_an_edit_that_cannot_be_done_changes_nothing_and_says_why(self):
        scene = self.value("twinarm.page.scene.scene")
        self.value("twinarm.page.send({do: 'edit', what: 'link-spring', name: 'rot'})")
        self.until(f"{STATE}.notes.some(note => note.text.includes(\"'rot' is no link\"))")
        self.assertEqual(self.value("twinarm.page.scene.scene"), scene)


if __name__ == "__main__":
    main()
