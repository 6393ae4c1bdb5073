"""`twinarm modes`: frequencies and damping against closed forms, and rejected input."""
import math

from program import main
from robot_command import HINGE, HINGE_INERTIA, PENDULUM, WHEELS, RobotCommand, joint, link, robot, slider


class Modes(RobotCommand):
    command = "modes"

    def scene(self, urdf, text):
        self.write("test.urdf", urdf)
        return str(self.write("scene.toml", '[[robot]]\nname = "arm"\nmodel = "test.urdf"\n' + text))

    def test_a_torsional_coupling_swings_with_k_over_I(self):
        k, b = 30.0, 0.4
        for measure in ("world", "joint"):
            for discretization in ("explicit", "implicit"):
                scene = self.scene(HINGE, '[[coupling]]\nname = "pull"\ntype = "torsional"\n'
                                   f'measure = "{measure}"\nlink = "rod"\nstiffness = {k}\n'
                                   f'damping = {b}\ndiscretization = "{discretization}"\n')
                mode, = self.answer(scene)["modes"]
                self.close([mode["frequency"], mode["damping_ratio"]],
                           [math.sqrt(k / HINGE_INERTIA), b / (2 * math.sqrt(k * HINGE_INERTIA))], 1e-11)
                self.assertEqual(mode["shape"], {"hinge": 1.0})
                self.assertGreater(mode["eigenvalue"][1], 0)

    def test_a_linear_coupling_adds_to_gravity(self):
        # A point of 1 kg on 1 m: w^2 = g/l + k/m about the lowest place, where the target is.
        scene = self.scene(PENDULUM, '[[coupling]]\nname = "pull"\ntype = "linear"\nlink = "bob"\n'
                           'point = [0, 0, -1]\nstiffness = 25\ndamping = 0\n')
        mode, = self.answer(scene)["modes"]
        self.close([mode["frequency"], mode["damping_ratio"]], [math.sqrt(9.81 + 25), 0], 1e-11)

    def test_a_pendulum_hangs_and_stands(self):
        mode, = self.answer(PENDULUM)["modes"]
        self.close([mode["frequency"]], [math.sqrt(9.81)], 1e-12)
        up = self.answer(PENDULUM, state={"q": {"hinge": math.pi}})["modes"]
        self.close(sorted(m["eigenvalue"][0] for m in up), [-math.sqrt(9.81), math.sqrt(9.81)])

    def test_a_damped_slider_drifts_and_decays(self):
        modes = self.answer(slider(damping=0.8, mass=2))["modes"]
        self.assertEqual(modes[0]["eigenvalue"], [0, 0])
        self.close(modes[1]["eigenvalue"], [-0.4, 0])

    def test_zeros_are_kept_two_for_each_drift(self):
        modes = self.answer(slider())["modes"]
        self.assertEqual([m["eigenvalue"] for m in modes], [[0, 0], [0, 0]])
        two = robot(link("a"), link("b"), joint("j", "continuous", "a", "b", xyz="1 0 0"))
        modes = self.answer(two, "--floating", "--gravity", "0,0,0")["modes"]
        self.assertEqual([m["frequency"] for m in modes], [0] * 14)

    def test_a_mimic_joint_adds_inertia_by_its_ratio(self):
        # Both joints slide along x: m1 + ratio^2 m2 on the spring of the mimicked joint.
        both = robot('<link name="base"/>', link("a", 2, (0, 0, 0)), link("b", 3, (0, 0, 0)),
                     joint("j1", "prismatic", "base", "a", axis="1 0 0"),
                     joint("j2", "prismatic", "base", "b", axis="1 0 0", more='<mimic joint="j1" multiplier="2"/>'))
        scene = self.scene(both, '[[coupling]]\nname = "pull"\ntype = "torsional"\n'
                           'measure = "joint"\nlink = "a"\nstiffness = 56\ndamping = 0\n')
        mode, = self.answer(scene)["modes"]
        self.close([mode["frequency"]], [math.sqrt(56 / (2 + 4 * 3))], 1e-11)

    def test_the_table_has_periods_and_shapes(self):
        text = self.run_it("assets/robots/puma560/puma560.urdf").stdout
        for word in ("[Hz]", "period", "damping ratio", "shapes"):
            self.assertIn(word, text)

    def test_a_state_that_is_not_an_equilibrium_gives_a_warning(self):
        tilted = self.answer(PENDULUM, state={"q": {"hinge": 0.5}})
        self.assertIn("not an equilibrium: 'hinge' accelerates", tilted["warnings"][-1])
        self.assertNotIn("equilibrium", "".join(self.answer(PENDULUM)["warnings"]))


# Two cranks hang from the ceiling, a bar between their ends: w^2 = g (m + M) / (l (2 m / 3 + M)).
LENGTH, CRANK, BAR, APART = 0.5, 1.5, 4.0, 0.8
STIFFNESS = 9.81 * (CRANK + BAR) * LENGTH         # of the angle [N m]
SWINGING = (2 * CRANK / 3 + BAR) * LENGTH ** 2    # [kg m^2]


def crank(name):
    about_com = CRANK * LENGTH ** 2 / 12
    return link(name, CRANK, (0, 0, -LENGTH / 2), (about_com, 0, 0, about_com, 0, 0.001))


PARALLELOGRAM = robot(
    '<link name="base"/>', crank("left"), crank("right"),
    link("bar", BAR, (APART / 2, 0, 0), (0.01, 0, 0, 0.3, 0, 0.3)),
    joint("j_left", "continuous", "base", "left", axis="0 1 0"),
    joint("j_right", "continuous", "base", "right", xyz=f"{APART} 0 0", axis="0 1 0"),
    joint("pin", "continuous", "left", "bar", xyz=f"0 0 {-LENGTH}", axis="0 1 0"))


class ModesOfLoops(RobotCommand):
    command = "modes"
    scene = Modes.scene

    def test_a_parallelogram_has_the_frequency_of_its_energies_with_every_type_of_pin(self):
        for kind, more in (("ball", ""), ("hinge", "axis = [0, 1, 0]\n")):
            scene = self.scene(PARALLELOGRAM, '[[constraint]]\nname = "far"\n'
                               f'type = "{kind}"\na = "arm/bar"\nb = "arm/right"\n'
                               f'point = [{APART}, 0, {-LENGTH}]\n{more}')
            found = self.answer(scene)
            mode, = found["modes"]
            self.close(mode["frequency"], math.sqrt(STIFFNESS / SWINGING), 1e-10)
            self.close([mode["shape"][j] for j in ("j_left", "j_right", "pin")], [1, 1, -1], 1e-9)
            self.assertEqual(len(found["rows"]), 1)
            self.assertEqual(len(found["A"]), 2)

    def test_a_coupling_and_a_damper_act_through_the_loop(self):
        k, b = 60.0, 0.9
        scene = self.scene(PARALLELOGRAM, '[[constraint]]\nname = "far"\ntype = "ball"\n'
                           f'a = "arm/bar"\nb = "arm/right"\npoint = [{APART}, 0, {-LENGTH}]\n'
                           '[[coupling]]\nname = "pull"\ntype = "torsional"\n'
                           f'measure = "joint"\nlink = "right"\nstiffness = {k}\n'
                           f'damping = {b}\n')
        mode, = self.answer(scene)["modes"]
        w = math.sqrt((STIFFNESS + k) / SWINGING)
        self.close([mode["frequency"], mode["damping_ratio"]], [w, b / (2 * SWINGING * w)], 1e-10)

    def test_free_bodies_with_constraints_have_shapes_under_their_names(self):
        # The same with three bodies; a fourth without constraints is left out.
        about = CRANK * LENGTH ** 2 / 12
        rod = ('shape = {{ box = {{ size = [0.02, 0.02, 0.5] }} }}\nmass = {m}\ngroup = 1\n'
               'inertia = [{i}, {i}, 0.001, 0, 0, 0]\ncom = [0, 0, 0]\n')
        text = "".join(f'[[body]]\nname = "{name}"\nposition = [{x}, 0, {z}]\n'
                       + rod.format(m=mass, i=i)
                       for name, x, z, mass, i in (
                           ("left", 0, -LENGTH / 2, CRANK, about),
                           ("right", APART, -LENGTH / 2, CRANK, about),
                           ("bar", APART / 2, -LENGTH, BAR, 0.3), ("loose", 9, 9, 1, 0.1)))
        for n, (a, b, x, z) in enumerate((("world", "left", 0, 0), ("world", "right", APART, 0),
                                          ("left", "bar", 0, -LENGTH),
                                          ("right", "bar", APART, -LENGTH))):
            text += (f'[[constraint]]\nname = "hinge{n}"\ntype = "hinge"\na = "{a}"\n'
                     f'b = "{b}"\npoint = [{x}, 0, {z}]\naxis = [0, 1, 0]\n')
        found = self.answer(str(self.write("scene.toml", text)))
        mode, = found["modes"]
        self.close(mode["frequency"], math.sqrt(STIFFNESS / SWINGING), 1e-9)
        shape = mode["shape"]
        self.assertEqual(sorted(shape), ["bar", "left", "right"])
        # The centres of the cranks move half as far as the bar, which does not rotate.
        turn = shape["left"][4]
        self.close(shape["bar"], [-LENGTH * turn, 0, 0, 0, 0, 0], 1e-9)
        self.close(shape["right"], [-LENGTH / 2 * turn, 0, 0, 0, turn, 0], 1e-9)

    def test_a_redundant_constraint_changes_nothing(self):
        scene = self.scene(PENDULUM, '[[constraint]]\nname = "tie"\ntype = "ball"\n'
                           'a = "arm/bob"\nb = "world"\npoint = [0, 0, 0]\n')
        mode, = self.answer(scene)["modes"]
        self.close(mode["frequency"], math.sqrt(9.81), 1e-11)

    def test_a_gear_adds_inertia_by_its_ratio(self):
        scene = self.scene(WHEELS, '[[constraint]]\nname = "mesh"\ntype = "gear"\n'
                           'a = "arm/ja"\nb = "arm/jb"\nratio = 3\n'
                           '[[coupling]]\nname = "pull"\ntype = "torsional"\n'
                           'measure = "joint"\nlink = "a"\nstiffness = 12\ndamping = 0\n')
        mode, = self.answer(scene)["modes"]
        self.close(mode["frequency"], math.sqrt(12 * 9 / (0.2 * 9 + 0.5)), 1e-10)


if __name__ == "__main__":
    main()
