"""Springs and force laws of scenes, against particles integrated here and closed forms."""
import math

from program import ProgramTest, main

TWO = """gravity = [0, 0, 0]
step = 0.0005
integrator = "{integrator}"
[[body]]
name = "a"
group = 1
mass = 2
shape = {{ sphere = {{ radius = 0.05 }} }}
[[body]]
name = "b"
group = 1
mass = 3
shape = {{ sphere = {{ radius = 0.05 }} }}
position = [0.6, 0, 0]
linear_velocity = [0, 0.3, 0]
[[spring]]
a = "a"
b = "b"
{keys}
"""
LAW = 'stiffness = 120\ndamping = 0.7\nrest_length = 0.5\n' \
      'force = "4[N/m^3] * (l - 50[cm])^3 + 0.2[N] * sin(5[1/s] * t)"'


def tension(t, length, rate):
    return 120 * (length - 0.5) + 0.7 * rate + 4 * (length - 0.5)**3 + 0.2 * math.sin(5 * t)


def particles(duration, steps):
    """Positions and velocities of a and b in the plane, by the classical Runge-Kutta method."""
    def rates(t, y):
        line = [y[2] - y[0], y[3] - y[1]]
        length = math.hypot(*line)
        e = [line[0] / length, line[1] / length]
        rate = e[0] * (y[6] - y[4]) + e[1] * (y[7] - y[5])
        f = tension(t, length, rate)
        return [*y[4:], f * e[0] / 2, f * e[1] / 2, -f * e[0] / 3, -f * e[1] / 3]

    y, h = [0, 0, 0.6, 0, 0, 0, 0, 0.3], duration / steps
    for n in range(steps):
        k1 = rates(n * h, y)
        k2 = rates((n + 0.5) * h, [a + 0.5 * h * b for a, b in zip(y, k1)])
        k3 = rates((n + 0.5) * h, [a + 0.5 * h * b for a, b in zip(y, k2)])
        k4 = rates((n + 1) * h, [a + h * b for a, b in zip(y, k3)])
        y = [a + h / 6 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(y, k1, k2, k3, k4)]
    return y


class Springs(ProgramTest):
    def scene(self, keys=LAW, integrator="rk4", text=TWO):
        return self.write("spring.toml", text.format(keys=keys, integrator=integrator))

    def hung(self, keys):
        """b on a spring to the world."""
        return self.scene(keys, text=TWO.replace('b = "b"', 'b = "world"').replace('a = "a"', 'a = "b"'))

    def test_two_bodies_move_as_particles_under_spring_damper_and_force_law(self):
        answer = self.json_of("simulate", self.scene(), "--duration", "2")
        expected = particles(2, 4000)
        last = answer["samples"][-1]["links"]
        for body, at in (("a", expected[:2]), ("b", expected[2:4])):
            for axis in (0, 1):
                self.assertAlmostEqual(last[body]["position"][axis], at[axis], delta=1e-10)

    def test_the_work_of_spring_damper_and_law_is_the_change_of_energy(self):
        answer = self.json_of("simulate", self.scene(), "--duration", "2")
        rows = answer["energy_balance"]
        y = particles(2, 4000)
        kinetic = 0.5 * 2 * (y[4]**2 + y[5]**2) + 0.5 * 3 * (y[6]**2 + y[7]**2)
        self.assertAlmostEqual(rows["spring/spring0"], 60 * (0.1**2 - (math.dist(y[:2], y[2:4]) - 0.5)**2), delta=1e-9)
        self.assertLess(rows["spring/spring0/damper"], -0.01)
        named = sum(rows[name] for name in ("spring/spring0", "spring/spring0/damper", "spring/spring0/law"))
        self.assertAlmostEqual(named, kinetic - 0.5 * 3 * 0.3**2, delta=1e-9)
        self.assertLess(abs(rows["numerical"]), 1e-9)

    def test_a_spring_to_the_world_gives_momentum_and_one_between_bodies_none(self):
        momentum = self.json_of("simulate", self.scene(), "--duration", 1)["momentum"]
        self.assertNotIn("spring/spring0", momentum)
        self.assertLess(max(map(abs, momentum["numerical"]["linear"])), 1e-12)
        hung = self.hung("stiffness = 50\npoint_b = [0.6, 0, 0.4]")
        momentum = self.json_of("simulate", hung, "--duration", 1)["momentum"]
        self.assertGreater(abs(momentum["spring/spring0"]["linear"][1]), 1e-3)
        self.assertLess(max(map(abs, momentum["numerical"]["linear"])), 1e-9)

    def test_a_mass_on_a_spring_has_its_natural_frequency(self):
        hung = self.hung("stiffness = 75\npoint_b = [0.6, 0, 0.4]\nrest_length = 0.4")
        modes = self.json_of("modes", hung)["modes"]
        self.assertAlmostEqual(max(abs(complex(*mode["eigenvalue"])) for mode in modes), 5, delta=1e-6)

    def test_inspect_names_the_force(self):
        text = self.twinarm("inspect", self.scene(), "--force", "spring/spring0").stdout
        self.assertIn("spring/spring0", text)

    def test_the_force_at_an_impact_is_that_of_the_velocity_after_it(self):
        scene = self.write("impact.toml", """
[[body]]
name = "floor"
fixed = true
restitution = 1
shape = { halfspace = { normal = [0, 0, 1], offset = 0 } }
[[body]]
name = "ball"
mass = 2
shape = { sphere = { radius = 0.05 } }
restitution = 0.5
position = [0, 0, 0.0501]
linear_velocity = [0, 0, -1]
[[spring]]
a = "ball"
b = "world"
point_b = [0, 0, 1]
damping = 30
""")
        text = self.twinarm("inspect", scene, "--force", "spring/spring0").stdout
        self.assertNotIn("FAIL", text)
        force = float(next(line for line in text.splitlines() if "on ball" in line).split()[4])
        self.assertAlmostEqual(force, -30 * 0.5, delta=0.1)

    def test_a_recording_replays_bit_by_bit(self):
        self.twinarm("simulate", self.scene(), "--duration", 0.5, "--record", self.folder / "spring.twinrec")
        self.twinarm("replay", self.folder / "spring.twinrec")

    def test_each_bad_spring_is_refused_with_its_line_and_a_remedy(self):
        for keys, words in (('stiffness = 100\nforce = "3[N/m] * t"', ("force", "at character")),
                            ('force = "3 * l *"', ("force", "at character")),
                            ('force = "3[N/m] * x"', ("force", "x")),
                            ("stiffness = -1", ("stiffness",)),
                            ("", ("stiffness", "is missing")),
                            ("stiffness = 1\nrest_length = -1", ("rest_length",)),
                            ("stiffness = 1\nlength = 1", ("length", "unknown key"))):
            with self.subTest(keys):
                error = self.twinarm("simulate", self.scene(keys), "--duration", 0.1, code=2).stderr
                self.assertIn("spring.toml:", error)
                for word in words:
                    self.assertIn(word, error)


if __name__ == "__main__":
    main()
