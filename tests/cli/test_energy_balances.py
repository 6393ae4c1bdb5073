"""Energy and momentum balance on every scene of assets/scenes, against energy and momentum from poses
and velocities (bodies_of_scene.py)."""
import json
import math

import program
from program import data, main, run
from bodies_of_scene import Contents, add, bodies_of, has_motors, size, symmetric
from recording_command import DRIVEN, RecordingCommand
from robot_command import COM, HINGE, HINGE_INERTIA, INERTIA, MASS, joint, link, robot

SCENES = [scene for scene in sorted(program.SCENES.glob("*.toml")) if not has_motors(scene)]
# Durations [s] that include contact.
DURATION = {"pyramid": 0.05, "box_stack": 0.1, "heap": 0.2, "bouncing_ball": 0.6, "cradle": 0.4,
            "rattleback": 0.1, "spinning_coin": 0.05, "four_bar": 0.4, "slider_crank": 0.4,
            "robot_beside_obstacles": 0.3, "peg_in_hole": 0.3, "arch": 0.1, "house_of_cards": 0.1, "dominoes": 0.1,
            "granular_column": 0.05, "wrecking_ball": 0.05}
IN_EVENT_STEPS = {"four_bar": 0.002, "arch": 0.002, "wrecking_ball": 0.002, "granular_column": 0.01}

FLOOR = data("floor.toml", offset=-5)
HAMMER = robot(
    '<link name="base"/>',
    '<link name="head"><inertial><origin xyz="0 0 -0.6"/><mass value="2"/><inertia ixx="0.3" '
    'ixy="0" ixz="0" iyy="0.3" iyz="0" izz="0.02"/></inertial><collision><origin xyz="0 0 -1"/>'
    '<geometry><sphere radius="0.1"/></geometry></collision></link>',
    joint("hinge", "continuous", "base", "head", axis="0 -1 0"))


class EnergyBalances(RecordingCommand):
    def run_scene(self, scene, *options):
        result = run("simulate", scene, *options, "--json")
        if result.returncode == 2:
            return None, result.stderr
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout), result.stderr

    def balance(self, scene, *options, bodies=None):
        """Residuals of both balances, relative to what was exchanged."""
        answer, error = self.run_scene(scene, *options)
        if answer is None:
            self.assertIn('contact = "event"', error)  # event-driven contact is not possible here
            return None
        self.assertNotIn("alarm", answer)
        bodies = bodies or bodies_of(scene)
        first, last = (Contents(bodies, answer["samples"][i]["links"]) for i in (0, -1))
        rows, momenta = answer["energy_balance"], answer["momentum"]
        moved = max([abs(w) for w in rows.values()] + [first.kinetic, last.kinetic, 1e-6])
        gained = last.kinetic - first.kinetic
        self.assertLess(abs(sum(rows.values()) - gained), 1e-12 * max(1, moved), scene.name)
        self.assertLess(abs(rows["gravity"] + last.potential - first.potential), 1e-12 * max(1, moved), scene.name)
        pushed = {}
        for part, gain in (("linear", add(last.linear, first.linear, -1)),
                           ("angular", add(last.angular, first.angular, -1))):
            total = (0, 0, 0)
            for row in momenta.values():
                total = add(total, row[part])
            pushed[part] = max([size(r[part]) for r in momenta.values()] + [size(getattr(first, part)), 1e-6])
            self.assertLess(size(add(total, gain, -1)), 1e-11 * max(1, pushed[part]), scene.name)
        return {"energy": abs(rows["numerical"]) / moved,
                "linear": size(momenta["numerical"]["linear"]) / pushed["linear"],
                "angular": size(momenta["numerical"]["angular"]) / pushed["angular"],
                "rows": rows, "momenta": momenta}

    def test_on_every_scene_the_rows_sum_to_the_change_of_energy_and_momentum(self):
        for scene in SCENES:
            for contact in ("rigid", "compliant", "event"):
                duration = DURATION.get(scene.stem, 0.3)
                if contact == "event":
                    duration = IN_EVENT_STEPS.get(scene.stem, min(duration, 0.05))
                with self.subTest(scene=scene.stem, contact=contact):
                    self.balance(scene, "--duration", duration, "--contact", contact)

    def test_the_residuals_fall_with_the_order_of_the_integrator(self):
        for name, integrator, order, steps, duration in (
                ("four_bar", "semi-implicit", 1, (4e-3, 2e-3), 0.4),
                ("four_bar", "verlet", 2, (4e-3, 2e-3), 0.4),
                ("four_bar", "rk4", 4, (1e-2, 5e-3), 0.4),
                ("slider_crank", "semi-implicit", 1, (2e-3, 1e-3), 0.4),
                ("slider_crank", "semi-implicit-xv", 1, (2e-3, 1e-3), 0.4),
                ("slider_crank", "implicit-midpoint", 2, (4e-3, 2e-3), 0.4),
                ("slider_crank", "rk4", 4, (1e-2, 5e-3), 0.4),
                # rolling, rocking, springs, swinging: permanent contacts
                ("rattleback", "semi-implicit", 1, (4e-4, 2e-4), 0.55),
                ("spinning_coin", "semi-implicit", 1, (4e-4, 2e-4), 0.1),
                ("peg_in_hole", "semi-implicit", 1, (1e-3, 5e-4), 0.1),
                ("robot_beside_obstacles", "semi-implicit", 1, (1e-3, 5e-4), 0.3),
                ("cradle", "semi-implicit", 1, (1e-3, 5e-4), 0.1)):
            scene = program.SCENES / f"{name}.toml"
            coarse, fine = (self.balance(scene, "--integrator", integrator, "--step", h,
                                         "--duration", duration) for h in steps)
            for key in ("energy", "linear", "angular"):
                self.assertLess(fine[key], max(0.7 * coarse[key] / 2 ** (order - 1), 1e-11),
                                f"{name} {integrator} {key} {coarse[key]}")

    def test_gravity_and_an_implicit_coupling_give_a_free_body_all_its_momentum(self):
        """The coupling's impulse needs the velocity at the end of the step, at the poses of its start."""
        self.write("ball.urdf", robot(link("ball", 2, (0, 0, 0), (0.1, 0, 0, 0.1, 0, 0.1))))
        scene = self.write("pulled.toml", '''step = 0.01
[[robot]]
name = "robot"
model = "ball.urdf"
base = "floating"
linear_velocity = [1, 0, 0]
[[coupling]]
name = "pull"
type = "linear"
link = "ball"
stiffness = 100
damping = 5
''')
        momenta = self.run_scene(scene, "--duration", 0.5)[0]["momentum"]
        for key in ("linear", "angular"):
            self.assertGreater(size(momenta["coupling/pull"][key]), 0.1, key)
            self.assertLess(size(momenta["numerical"][key]), 1e-12, key)

    def test_the_work_of_a_prescribed_body_is_in_the_row_of_the_constraint(self):
        """A body hangs by a ball joint on a body with prescribed rotation: its energy changes by that row."""
        scene = self.write("driven.toml", DRIVEN)
        for integrator, options, tolerance in (
                ("dopri5", ("--tolerance", 1e-11), 1e-9), ("rk4", ("--step", 1e-3), 1e-8),
                ("semi-implicit", ("--step", 1e-4), 1e-2)):
            found = self.balance(scene, "--duration", 1, "--integrator", integrator, *options)
            for key in ("energy", "linear", "angular"):
                self.assertLess(found[key], tolerance, f"{integrator} {key} {found['rows']}")
            self.assertGreater(abs(found["rows"]["constraint/hook"]), 0.1)

    def test_a_driven_constraint_does_the_same_work_in_impulse_based_steps(self):
        """A floor far below selects steps with contacts; the work is the same."""
        by_force = self.write("driven.toml", DRIVEN)
        by_impulse = self.write("floor.toml", DRIVEN.replace('integrator = "rk4"\n', "") + FLOOR)
        exact = self.balance(by_force, "--duration", 0.5, "--integrator", "dopri5", "--tolerance",
                             1e-11)["rows"]["constraint/hook"]
        for contact, step, tolerance in (("event", 5e-3, 1e-8), ("rigid", 1e-3, 2e-2), ("compliant", 5e-4, 1e-2)):
            found = self.balance(by_impulse, "--duration", 0.5, "--contact", contact, "--step", step)
            self.assertLess(found["energy"], tolerance, contact)
            self.assertLess(found["linear"], tolerance, contact)
            self.close(found["rows"]["constraint/hook"] / exact, 1, tolerance, contact)

    def test_the_correction_of_a_joint_beyond_its_limit_has_its_own_row(self):
        """Released 0.1 rad beyond it, alone and beside a ball at rest on a floor."""
        self.write("test.urdf", robot(
            '<link name="base"/>', link("rod"),
            joint("hinge", "revolute", "base", "rod", axis="0 1 0",
                  more='<limit lower="-0.2" upper="0.2" effort="1" velocity="1"/>')))
        arm = '[[robot]]\nname = "arm"\nmodel = "test.urdf"\nq = { hinge = 0.3 }\n'
        ball = ('[[body]]\nname = "ball"\nshape = { sphere = { radius = 0.1 } }\nmass = 1\n'
                'position = [3, 0, -4.9]\n')
        for text in (arm, arm + FLOOR + ball):
            rows = self.balance(self.write("limit.toml", text), "--duration", 0.1)["rows"]
            self.assertGreater(abs(rows["joint/hinge/limit/stabilisation"]), 1e-3)
            self.assertNotIn("contact/stabilisation", rows)

    def test_with_dormand_prince_both_balances_close_on_smooth_scenes(self):
        for name in ("four_bar", "slider_crank"):
            found = self.balance(program.SCENES / f"{name}.toml", "--integrator",
                                 "dopri5", "--tolerance", 1e-11, "--duration", 0.5)
            for key in ("energy", "linear", "angular"):
                self.assertLess(found[key], 1e-9, f"{name} {key}")

    def test_the_ground_receives_the_impulse_of_a_hinged_hammer(self):
        """Off the centre of percussion the hinge transmits an impulse at the impact."""
        self.write("test.urdf", HAMMER)
        scene = self.write("hammer.toml", data("blow.toml"))
        bodies = {"ball": (1, (0, 0, 0), symmetric(0.004, 0.004, 0.004)),
                  "head": (2, (0, 0, -0.6), symmetric(0.3, 0.3, 0.02))}
        for contact, step, tolerance in (("rigid", 1e-3, 5e-3), ("rigid", 2.5e-4, 1.2e-3), ("event", 0.02, 1e-3)):
            found = self.balance(scene, "--duration", 0.3, "--contact", contact, "--step", step, bodies=bodies)
            self.assertIn("contact/head-ball/impact", found["rows"])
            for part in ("linear", "angular"):
                self.assertLess(found[part], tolerance, f"{contact} {step} {part}")
            self.assertIn("joint/hinge", found["momenta"])
            self.assertNotIn("contact/head-ball", found["momenta"])  # between two moving bodies


class Joints(RecordingCommand):
    command = "simulate"

    def test_friction_and_damping_take_what_closed_forms_say_from_a_flywheel(self):
        """I w' = -c, until it stands, and I w' = -b w; the row without the remainder is the loss."""
        inertia, start, friction, damping = HINGE_INERTIA, 3, 0.4, 0.3
        loss = {}
        for duration in (1, 5):  # it stands after 3.75 s
            speed = max(0, start - friction / inertia * duration)
            loss[f'friction="{friction}"', duration] = ("friction", inertia / 2 * (speed**2 - start**2))
        loss[f'damping="{damping}"', 1] = (
            "damping", inertia / 2 * start**2 * (math.exp(-2 * damping / inertia) - 1))
        for (dynamics, duration), (row, work) in loss.items():
            flywheel = HINGE.replace("</joint>", f"<dynamics {dynamics}/></joint>")
            for options, tolerance in ((["semi-implicit", "--step", 1e-3], 1e-3), (["rk4", "--step", 1e-3], 2e-4),
                                       (["dopri5", "--tolerance", 1e-11], 1e-9)):
                rows = self.answer(flywheel, "--duration", duration, "--integrator", *options,
                                   state={"qd": {"hinge": start}})["energy_balance"]
                self.assertEqual(list(rows), ["gravity", f"joint/hinge/{row}", "numerical"])
                self.close(rows[f"joint/hinge/{row}"] / work, 1, tolerance, f"{dynamics} {options}")

    def test_the_impulse_through_the_joint_to_the_ground_is_newtons_law_for_the_robot(self):
        """With three integrators, motor, friction and wrench, from the total momentum of the links."""
        urdf = robot('<link name="base"/>', link("upper"), link("lower"),
                     joint("shoulder", "continuous", "base", "upper", axis="0 1 0",
                           more='<dynamics damping="0.4" friction="0.2"/>'),
                     joint("elbow", "continuous", "upper", "lower", xyz="0 0 -1", axis="1 0 0"))
        state = {"q": {"shoulder": 0.4}, "qd": {"elbow": 2}, "tau": {"elbow": 0.7},
                 "wrenches": [{"link": "lower", "point": [0, 0, -1.5], "force": [1, 2, 3]}]}
        m, i = MASS, INERTIA
        inertia = ((i[0], i[1], i[2]), (i[1], i[3], i[4]), (i[2], i[4], i[5]))
        bodies = {name: (m, COM, inertia) for name in ("upper", "lower")}
        for options, tolerance in ((["semi-implicit", "--step", 1e-4], 2e-3),
                                   (["rk4", "--step", 1e-3], 1e-9),
                                   (["dopri5", "--tolerance", 1e-11], 1e-9)):
            answer = self.answer(urdf, "--duration", 0.5, "--integrator", *options, state=state)
            rows = answer["momentum"]
            self.assertEqual(list(rows), ["gravity", "wrench/0", "joint/shoulder", "numerical"])
            self.close(rows["wrench/0"]["linear"], [0.5, 1, 1.5])
            self.close(rows["gravity"]["linear"], [0, 0, -9.81 * 2 * m * 0.5])
            first, last = (Contents(bodies, answer["samples"][n]["links"]) for n in (0, -1))
            for part in ("linear", "angular"):
                gained = add(getattr(last, part), getattr(first, part), -1)
                for row in ("gravity", "wrench/0", "joint/shoulder"):
                    gained = add(gained, rows[row][part], -1)
                self.assertLess(size(gained), tolerance * size(rows["gravity"]["linear"]), f"{options} {part}")


if __name__ == "__main__":
    main()
