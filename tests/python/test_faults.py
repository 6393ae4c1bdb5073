"""What is wrong is refused, and reported with its remedy; what a robot says of itself."""
import numpy as np

from notebook import DOUBLE_PENDULUM, PUMA, ProgramTest, every_joint, main, states, twinarm


class Faults(ProgramTest):
    def setUp(self):
        super().setUp()
        self.puma = twinarm.load(PUMA)
        self.zero = np.zeros(6)

    def reported(self, kind, words, function, *arguments, **named):
        with self.assertRaisesRegex(kind, words):
            function(*arguments, **named)

    def test_wrong_shapes_are_refused_with_the_right_one(self):
        z = self.zero
        self.reported(ValueError, r"aba\(\): q has shape \(5,\), must have \(6,\) or \(N, 6\).*nq = 6",
                      twinarm.aba, self.puma, z[:5], z, z)
        self.reported(ValueError, r"rnea\(\): qdd has shape \(2, 3\)", twinarm.rnea, self.puma, z, z, np.zeros((2, 3)))
        self.reported(ValueError, r"q has shape \(\)", twinarm.crba, self.puma, 1.0)
        self.reported(ValueError, r"q has shape \(1, 1, 6\)", twinarm.crba, self.puma, np.zeros((1, 1, 6)))
        self.reported(ValueError, "3 rows, another 2", twinarm.aba, self.puma, np.zeros((3, 6)), z, np.zeros((2, 6)))
        self.reported(ValueError, r"f_ext has shape \(6,\), must have \(\d+, 6\)", twinarm.aba, self.puma, z, z, z, z)
        self.reported(ValueError, r"poses\(\): q has shape \(5,\)", twinarm.poses, self.puma, z[:5])
        self.reported(ValueError, "point has shape", twinarm.jacobian, self.puma, z, "link3", [1, 2])
        self.reported(ValueError, "gravity has shape", setattr, self.puma, "gravity", [1, 2])

    def test_an_out_that_does_not_fit_is_refused_and_nothing_is_written(self):
        frozen = np.full(6, 7.0)
        frozen.flags.writeable = False
        for out in (np.full(5, 7.0), np.full((1, 6), 7.0), np.full(6, 7.0, dtype=np.float32),
                    np.full((6, 2), 7.0)[:, 0], frozen, [7.0] * 6):
            self.reported(ValueError, r"out must be a writeable array of shape \(6,\)", twinarm.aba,
                          self.puma, self.zero, self.zero, self.zero, out=out)
            self.assertTrue(np.all(np.asarray(out) == 7))

    def test_what_is_no_finite_number_is_refused_with_its_place(self):
        for bad in (np.nan, np.inf, -np.inf):
            q = self.zero.copy()
            q[4] = bad
            self.reported(ValueError, r"aba\(\): q\[4\] is -?(nan|inf)",
                          twinarm.aba, self.puma, q, self.zero, self.zero)
            self.reported(ValueError, r"energy\(\): qd\[4\]", twinarm.energy, self.puma, self.zero, q)
        rows = np.zeros((3, 6))
        rows[2, 1] = np.nan
        self.reported(ValueError, r"crba\(\): q\[2\]\[1\] is nan", twinarm.crba, self.puma, rows)
        sim = twinarm.Simulation(self.puma)
        self.reported(ValueError, r"tau\[0\] is nan", setattr, sim, "tau", rows[2][[1] * 6])

    def test_what_is_no_number_at_all_and_wrong_arguments_are_refused(self):
        z = self.zero
        self.reported(TypeError, "q must be an array of real numbers, is a str", twinarm.aba, self.puma, "here", z, z)
        self.reported(TypeError, "is a ndarray", twinarm.crba, self.puma, z * 1j)
        self.reported(TypeError, "must be a twinarm.Model, is a", twinarm.aba, z, z, z, z)
        self.reported(TypeError, "'tau' is missing", twinarm.aba, self.puma, z, z)
        for missing in range(4):
            given = [self.puma, z, z, z]
            given[missing] = None
            self.reported(TypeError, r"aba\(\): '.*' is missing", twinarm.aba, *given)
        self.reported(TypeError, "'torque' is not an argument", twinarm.aba, self.puma, z, z, torque=z)
        self.reported(TypeError, "'q' is given twice", twinarm.aba, self.puma, z, z, z, q=z)
        self.reported(TypeError, "at most 3", twinarm.crba, self.puma, z, None, z)
        self.reported(ValueError, "no body 'link33'.*'link3'", twinarm.jacobian, self.puma, z, "link33")
        self.reported(ValueError, "no integrator 'rk5'.*'rk4'", twinarm.Simulation, self.puma, integrator="rk5")
        self.reported(ValueError, "h must be positive", twinarm.Simulation, self.puma, h=0)
        self.reported(ValueError, "no scheme 'eulr'.*'explicit Euler'", twinarm.largest_omega_h, "eulr", 0)
        self.reported(ValueError, "must be square", twinarm.largest_stable_step,
                      [[1, 2]], [[1]], [[1]], "explicit Euler")

    def test_a_quaternion_without_unit_length_is_refused(self):
        model = twinarm.load(self.write("all.urdf", every_joint()), floating=True)
        q, qd, tau = (rows[0] for rows in states(model, 1))
        place = model.q_of["spherical"]
        q[place] *= 1.1
        self.reported(ValueError, rf"q\[{place.start}:{place.stop}\] must be a unit quaternion.*1.1",
                      twinarm.aba, model, q, qd, tau)

    def test_files_that_are_missing_or_wrong_are_reported_with_all_faults(self):
        self.reported(twinarm.InputError, "nowhere.urdf", twinarm.load, "nowhere.urdf")
        self.reported(ValueError, "nowhere.toml", twinarm.simulate, "nowhere.toml")
        self.reported(twinarm.InputError, "nowhere.twinrec", twinarm.open_recording, "nowhere.twinrec")
        self.reported(twinarm.InputError, "not a twinarm recording", twinarm.open_recording, PUMA)
        self.reported(twinarm.InputError, "has no coupling", twinarm.predict_couplings, "assets/scenes/pendulum.toml")
        self.reported(ValueError, "duration", twinarm.simulate, DOUBLE_PENDULUM)
        text = '<robot name="r"><link name="a"/><link name="b"><inertial><mass value="-1"/></inertial>' \
               '</link>\n<joint name="j" type="hinge"><parent link="a"/><child link="b"/></joint></robot>'
        with self.assertRaises(twinarm.InputError) as caught:
            twinarm.load(self.write("bad.urdf", text))
        self.assertGreaterEqual(len(str(caught.exception).splitlines()), 2)
        self.assertIn("bad.urdf:2", str(caught.exception))

    def test_a_model_outlives_its_name_and_copies_cannot_be_written_to(self):
        sim = twinarm.Simulation(twinarm.load(DOUBLE_PENDULUM), [1, 0])
        sim.step(10)
        with self.assertRaises(ValueError):
            sim.q[0] = 1
        with self.assertRaises(ValueError):
            self.puma.gravity[2] = 0


class Robots(ProgramTest):
    def test_a_robot_says_its_joints_their_places_and_limits(self):
        model = twinarm.load(self.write("all.urdf", every_joint()), floating=True)
        self.assertEqual(model.name, "all")
        self.assertEqual(model.bodies[1:], [f"l{n}" for n in range(8)])
        self.assertEqual(model.parent[1:], list(range(8)))
        self.assertEqual(model.joint_types[1:], ["free", "revolute", "prismatic", "spherical", "universal",
                                                 "cylindrical", "screw", "planar"])
        self.assertEqual([model.nq, model.nv], [7 + 1 + 1 + 4 + 2 + 2 + 1 + 3, 6 + 1 + 1 + 3 + 2 + 2 + 1 + 3])
        slide = model.q_of["prismatic"]
        self.assertEqual([model.lower[slide], model.upper[slide]], [-10, 10])
        self.assertEqual(model.largest_speed[model.qd_of["prismatic"]], 3)
        self.assertEqual(model.largest_effort[model.qd_of["prismatic"]], 7)
        self.assertEqual(np.isinf(model.lower).sum(), model.nq - 1)
        np.testing.assert_array_equal(model.gravity, [0, 0, -9.81])
        self.assertIn("nv = 19", repr(model))


if __name__ == "__main__":
    main()
