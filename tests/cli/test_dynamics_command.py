"""`twinarm dynamics`: its numbers against published values and closed forms."""
import math

from program import ROOT, main
from robot_command import (COM, INERTIA, MASS, PENDULUM, RobotCommand, add, cross, dot,
                           from_quaternion, inertia_about_origin, joint, link, one_body, robot,
                           rotation, scale, symmetric, times, transpose, unit)

PUMA = "assets/robots/puma560/puma560.urdf"
STATES = ROOT / "assets" / "states"
TURN = unit([0.5, -0.3, 0.7, 0.2])


class Puma560(RobotCommand):
    """Values of an independent computation, all of whose published digits agree."""
    command = "dynamics"

    def by_joint(self, answer, key):
        return [answer[key][f"j{n}"] for n in range(1, 7)]

    def test_gravity_loads_and_mass_matrix_in_the_nominal_pose(self):
        answer = self.answer(PUMA, state=STATES / "puma_qn.json")
        self.assertEqual(answer["joints"], [f"j{n}" for n in range(1, 7)])
        self.close(answer["gravity"], [0, 31.639880378357127, 6.0351380230105125, 0, 0.028252800000000012, 0])
        self.close(answer["bias"], answer["gravity"])
        M = answer["mass_matrix"]
        self.close([M[i][i] for i in range(6)], [3.65937541215279, 4.413741933635791, 0.9378415752150396,
                                                 0.19253170612368, 0.17134845165700002, 0.19410450566800005])
        self.close([M[0][1], M[0][2], M[1][2]], [-0.4043612460415188, 0.10061364777978393, 0.35089066495641474])
        self.close(M, transpose(M), 0)
        self.close(answer["mass"], 23.45)

    def test_inverse_dynamics_with_and_without_rotors_and_friction(self):
        from_rest = self.answer(PUMA, state=STATES / "puma_qn_accelerating.json")
        self.close(self.by_joint(from_rest, "tau_inverse"),
                   [3.353110858063025, 36.002511243975704, 7.425964077350271,
                    0.19004303456689686, 0.2034409311134147, 0.1941327899392475])
        ones = STATES / "puma_qn_ones.json"
        self.close(self.by_joint(self.answer(PUMA, state=ones), "tau_inverse"),
                   [32.49524275493071, 60.86698847513631, 17.74359491276432,
                    1.4545190260797085, 1.2991104105378863, 0.7137808874836951])
        links = self.answer(PUMA, "--no-friction", "--no-armature", state=ones)
        self.close(self.by_joint(links, "tau_inverse"),
                   [1.1780065183379018, 35.460614988311306, 6.097063990454122,
                    0.00047549025887667516, 0.03511411794548652, 0.00021656854249492408])

    def test_forward_dynamics_with_and_without_friction(self):
        moving = STATES / "puma_qn_moving.json"
        self.close(self.by_joint(self.answer(PUMA, state=moving), "qdd"),
                   [-7.410223163685557, -9.843224581568439, -10.969398445087409,
                    -4.431428751376355, -0.9881410723986468, 21.02278194928692], 1e-11)
        self.close(self.by_joint(self.answer(PUMA, "--no-friction", state=moving), "qdd"),
                   [-0.3540475686208445, -6.3989262832367535, -2.0684942474671573,
                    0.5112435385571794, 4.021223156468258, 23.698454065202604], 1e-11)

    def test_what_it_was_read_with_stands_under_warnings_and_on_stderr(self):
        answer = self.answer(PUMA)
        self.assertTrue(any("link3" in warning for warning in answer["warnings"]))
        done = self.run_it(PUMA)
        table = done.stdout
        for heading in ("q [rad]", "qdd [rad/s^2]", "tau [N m]", "mass matrix", "x [m]"):
            self.assertIn(heading, table)
        self.assertIn("twinarm: warning: ", done.stderr)
        self.assertNotIn("warning", table)


class ClosedForms(RobotCommand):
    command = "dynamics"

    def test_two_links_in_a_plane_have_the_mass_matrix_and_coriolis_terms_of_the_textbook(self):
        m1, m2, l1, c1, c2, I1, I2 = 3.0, 2.0, 0.5, 0.2, 0.3, 0.07, 0.05
        urdf = robot('<link name="base"/>', link("upper", m1, (c1, 0, 0), (I1, 0, 0, I1, 0, I1)),
                     link("fore", m2, (c2, 0, 0), (I2, 0, 0, I2, 0, I2)), joint("j1", "continuous", "base", "upper"),
                     joint("j2", "continuous", "upper", "fore", xyz=f"{l1} 0 0"))
        q2, v1, v2 = 0.9, 1.3, -0.7
        answer = self.answer(urdf, state={"q": {"j1": 0.4, "j2": q2}, "qd": {"j1": v1, "j2": v2},
                                          "tau": {"j1": 0.6, "j2": -0.2}})
        M12 = I2 + m2 * (c2 ** 2 + l1 * c2 * math.cos(q2))
        M11 = I1 + m1 * c1 ** 2 + I2 + m2 * (l1 ** 2 + c2 ** 2 + 2 * l1 * c2 * math.cos(q2))
        M22 = I2 + m2 * c2 ** 2
        h = m2 * l1 * c2 * math.sin(q2)
        bias = [-h * (2 * v1 * v2 + v2 ** 2), h * v1 ** 2]
        self.close(answer["mass_matrix"], [[M11, M12], [M12, M22]])
        self.close(answer["bias"], bias)
        self.close(answer["gravity"], [0, 0])
        self.close(times(answer["mass_matrix"], list(answer["qdd"].values())), [0.6 - bias[0], -0.2 - bias[1]])
        self.close(answer["kinetic_energy"], (M11 * v1 ** 2 + 2 * M12 * v1 * v2 + M22 * v2 ** 2) / 2)

    def floating_state(self):
        return {"base": {"position": [1, 2, 3], "orientation": TURN,
                         "linear_velocity": [0.3, -0.2, 0.5], "angular_velocity": [1.1, -0.7, 0.4],
                         "linear_acceleration": [0.2, 0.9, -0.4],
                         "angular_acceleration": [-0.5, 0.3, 0.8]}}

    def test_a_floating_body_with_a_spin_keeps_newtons_and_eulers_laws_about_its_origin(self):
        state = self.floating_state()
        base = state["base"]
        p, w, R = base["position"], base["angular_velocity"], from_quaternion(TURN)
        force, torque, point = [0.4, -1.2, 0.7], [0.3, 0.1, -0.6], [1.5, 1.0, 2.0]
        f_link, t_link, p_link = [2.0, 0.1, -0.3], [0.2, 0.0, 0.5], [0.3, -0.1, 0.2]
        state["wrenches"] = [
            {"link": "body", "point": point, "force": force, "torque": torque},
            {"link": "body", "frame": "link", "point": p_link, "force": f_link, "torque": t_link}]
        answer = self.answer(robot(link("body")), "--floating", state=state)
        M, bias = one_body(R, w)
        self.assertEqual(answer["joints"], [])
        self.close(answer["mass_matrix"], M)
        self.close(answer["bias"], bias)
        self.close(answer["gravity"], one_body(R, [0, 0, 0])[1])
        f2, r = times(R, f_link), add(point, scale(-1, p))
        applied = add(force, f2) + add(torque, cross(r, force), times(R, t_link), cross(times(R, p_link), f2))
        found = answer["base_acceleration"]["linear"] + answer["base_acceleration"]["angular"]
        self.close(add(times(M, found), bias), applied)
        given = base["linear_acceleration"] + base["angular_acceleration"]
        needed = add(times(M, given), bias, scale(-1, applied))
        self.close(answer["base_wrench"]["force"] + answer["base_wrench"]["torque"], needed)

        c = times(R, list(COM))
        v_com = add(base["linear_velocity"], cross(w, c))
        I_com = times(times(R, symmetric(*INERTIA)), transpose(R))
        self.close(answer["com"], add(p, c))
        self.close(answer["linear_momentum"], scale(MASS, v_com))
        self.close(answer["angular_momentum"], add(times(I_com, w), scale(MASS, cross(add(p, c), v_com))))
        self.close(answer["kinetic_energy"], MASS * dot(v_com, v_com) / 2 + dot(w, times(I_com, w)) / 2)
        self.close(answer["potential_energy"], MASS * 9.81 * (p[2] + c[2]))
        body = answer["links"]["body"]
        self.close(body["rotation"], R)
        self.close(body["orientation"], TURN)
        self.close(body["linear_velocity"], base["linear_velocity"])
        self.close(body["angular_velocity"], w)

    def test_a_floating_joint_in_the_tree_has_velocities_and_forces_in_its_frames_axes(self):
        roll = 0.8
        urdf = robot('<link name="base"/>', link("body"),
                     joint("free", "floating", "base", "body", xyz="0.1 0 0.2", rpy=f"{roll} 0 0"))
        state = self.floating_state()["base"]
        velocity = state["linear_velocity"] + state["angular_velocity"]
        acceleration = state["linear_acceleration"] + state["angular_acceleration"]
        tau = [0.3, -0.4, 0.9, 0.2, 0.8, -0.1]
        answer = self.answer(urdf, state={"q": {"free": [1, 2, 3, *TURN]}, "qd": {"free": velocity},
                                          "qdd": {"free": acceleration}, "tau": {"free": tau}})
        J = rotation([1, 0, 0], roll, math.cos, math.sin)  # the joint's frame in the world
        g = times(transpose(J), [0, 0, -9.81])
        M, bias = one_body(from_quaternion(TURN), velocity[3:], g=g)
        self.close(answer["mass_matrix"], M)
        self.close(answer["bias"], bias)
        self.close(add(times(M, answer["qdd"]["free"]), bias), tau)
        self.close(answer["tau_inverse"]["free"], add(times(M, acceleration), bias))
        self.close(answer["links"]["body"]["linear_velocity"], times(J, velocity[:3]))
        self.close(answer["links"]["body"]["position"], add([0.1, 0, 0.2], times(J, [1, 2, 3])))

    def test_a_spherical_joint_has_rates_and_torques_in_the_childs_axes(self):
        urdf = robot('<link name="base"/>', link("body"), joint("ball", "spherical", "base", "body"))
        w, alpha, tau = [1.2, -0.4, 0.8], [0.3, 0.5, -0.7], [0.1, 0.2, -0.3]
        answer = self.answer(urdf, state={"q": {"ball": TURN}, "qd": {"ball": w},
                                          "qdd": {"ball": alpha}, "tau": {"ball": tau}})
        I = inertia_about_origin()
        g = times(transpose(from_quaternion(TURN)), [0, 0, -9.81])
        bias = add(cross(w, times(I, w)), scale(-MASS, cross(list(COM), g)))
        self.close(answer["mass_matrix"], I)
        self.close(answer["bias"], bias)
        self.close(answer["tau_inverse"]["ball"], add(times(I, alpha), bias))
        self.close(add(times(I, answer["qdd"]["ball"]), bias), tau)
        self.close(answer["links"]["body"]["angular_velocity"], times(from_quaternion(TURN), w))

    def test_a_fixed_root_counts_in_mass_and_centre_and_weighs_on_the_world(self):
        urdf = robot(link("base", 4, (1, 0, 0)), link("body", 2, (0, 0, 0)),
                     joint("slide", "prismatic", "base", "body", axis="0 0 1"))
        answer = self.answer(urdf, state={"q": {"slide": 0.5}, "qdd": {"slide": 3.0}})
        self.close(answer["mass"], 6)
        self.close(answer["com"], [4 / 6, 0, 1 / 6])
        self.close(answer["base_wrench"]["force"], [0, 0, 6 * 9.81 + 2 * 3])
        self.close(answer["base_wrench"]["torque"], [0, -4 * 9.81, 0])
        self.close(answer["tau_inverse"]["slide"], 2 * (9.81 + 3))

    def test_a_mimic_joint_counts_through_its_ratio_and_is_not_named(self):
        m, ratio = 2.0, -1.5
        urdf = robot('<link name="base"/>', link("a", m, (0, 0, 0)), link("b", m, (0, 0, 0)),
                     joint("lead", "prismatic", "base", "a"),
                     joint("follow", "prismatic", "base", "b",
                           more=f'<mimic joint="lead" multiplier="{ratio}" offset="0.2"/>'))
        answer = self.answer(urdf, state={"q": {"lead": 0.3}, "qd": {"lead": 0.7},
                                          "tau": {"lead": 1.0}, "qdd": {"lead": 2.0}})
        self.assertEqual(answer["joints"], ["lead"])
        M, bias = m * (1 + ratio ** 2), m * 9.81 * (1 + ratio)
        self.close(answer["mass_matrix"], [[M]])
        self.close(answer["bias"], [bias])
        self.close(answer["qdd"]["lead"], (1 - bias) / M)
        self.close(answer["tau_inverse"]["lead"], 2 * M + bias)
        self.close(answer["links"]["b"]["position"], [0, 0, ratio * 0.3 + 0.2])
        self.close(answer["links"]["b"]["linear_velocity"], [0, 0, ratio * 0.7])

    def test_friction_holds_at_rest_up_to_its_limit_and_brakes_what_moves(self):
        urdf = robot('<link name="base"/>', link("body", 2, (0, 0, 0)),
                     joint("slide", "prismatic", "base", "body", axis="1 0 0",
                           more='<dynamics damping="0.5" friction="3"/>'))
        for tau, qd, force in ((2.9, 0, 0), (3.4, 0, 0.4), (-4, 0, -1), (1, 0.2, 1 - 3 - 0.1)):
            answer = self.answer(urdf, state={"tau": {"slide": tau}, "qd": {"slide": qd}})
            self.close(answer["qdd"]["slide"], force / 2)
        frictionless = self.answer(urdf, "--no-friction", state={"tau": {"slide": 2.9}})
        self.close(frictionless["qdd"]["slide"], 2.9 / 2)

    def test_gravity_may_point_anywhere(self):
        answer = self.answer(PENDULUM, "--gravity", "-2,0,0")
        self.close(answer["qdd"]["hinge"], -2)


if __name__ == "__main__":
    main()
