"""`twinarm dynamics`: what is nearly a fault, and computed. What is refused: tests/data/refusals.toml."""
from program import DATA, main
from robot_command import PENDULUM, RobotCommand


class Faults(RobotCommand):
    command = "dynamics"

    def test_a_quaternion_must_have_unit_length_but_for_the_digits_it_was_typed_with(self):
        nearly = [0.7071068, 0.7071068, 0, 0]
        answer = self.answer(str(DATA / "ball_joint.urdf"), state={"q": {"ball": nearly}})
        self.assertTrue(any("normalised" in warning for warning in answer["warnings"]))
        self.close(answer["links"]["body"]["rotation"], [[1, 0, 0], [0, 0, -1], [0, 1, 0]], 1e-15)

    def test_an_inertia_that_no_body_has_is_a_warning(self):
        warnings = self.answer(str(DATA / "disc.urdf"))["warnings"]
        self.assertTrue(any("disc" in w and "A + B >= C" in w for w in warnings), warnings)

    def test_speeds_whose_squares_are_finite_are_computed(self):
        self.assertEqual(self.run_it(PENDULUM, state={"qd": {"hinge": 1e100}}).returncode, 0)


if __name__ == "__main__":
    main()
