"""aba, rnea, crba, minv and what stands in world axes, against closed forms, one another and the program."""
import json

import numpy as np

from notebook import DOUBLE_PENDULUM, PUMA, ProgramTest, every_joint, main, program, states, twinarm


class ClosedForm(ProgramTest):
    """Two rods of 0.5 m and 1 kg: the Lagrangian, written down by hand."""
    l, c, m, I, g = 0.5, 0.25, 1.0, 1 / 48, 9.81

    def mass_matrix(self, q):
        cos = np.cos(q[1])
        corner = self.I + self.m * (self.c ** 2 + self.l * self.c * cos)
        first = 2 * self.I + self.m * (2 * self.c ** 2 + self.l ** 2 + 2 * self.l * self.c * cos)
        return np.array([[first, corner], [corner, self.I + self.m * self.c ** 2]])

    def bias(self, q, v):
        h = self.m * self.l * self.c * np.sin(q[1])
        low = self.m * self.c * self.g * np.sin(q[0] + q[1])
        high = self.m * (self.c + self.l) * self.g * np.sin(q[0])
        return np.array([high + low - h * (2 * v[0] * v[1] + v[1] ** 2), low + h * v[0] ** 2])

    def test_the_double_pendulum_has_the_equations_of_the_textbook(self):
        model = twinarm.load(DOUBLE_PENDULUM)
        for q, qd, tau in zip(*states(model, 20)):
            M, bias = self.mass_matrix(q), self.bias(q, qd)
            np.testing.assert_allclose(twinarm.crba(model, q), M, rtol=1e-13)
            np.testing.assert_allclose(twinarm.rnea(model, q, qd, tau), M @ tau + bias, atol=1e-13)
            np.testing.assert_allclose(twinarm.aba(model, q, qd, tau), np.linalg.solve(M, tau - bias), atol=1e-11)
            np.testing.assert_allclose(twinarm.minv(model, q), np.linalg.inv(M), rtol=1e-12)
            T, V = twinarm.energy(model, q, qd)
            self.assertAlmostEqual(T, qd @ M @ qd / 2, places=13)
            height = -0.75 * np.cos(q[0]) - 0.25 * np.cos(q.sum())
            self.assertAlmostEqual(V, self.g * height, places=12)

    def test_derivatives_of_the_double_pendulum_are_those_of_the_textbook(self):
        model, s = twinarm.load(DOUBLE_PENDULUM), 1e-5
        for q, qd, tau in zip(*states(model, 20)):
            def qdd(q, qd, tau):
                return np.linalg.solve(self.mass_matrix(q), tau - self.bias(q, qd))
            found = twinarm.aba_derivatives(model, q, qd, tau)
            for k, e in enumerate(s * np.eye(2)):
                columns = [(qdd(q + e, qd, tau) - qdd(q - e, qd, tau)), (qdd(q, qd + e, tau) - qdd(q, qd - e, tau)),
                           (qdd(q, qd, tau + e) - qdd(q, qd, tau - e))]
                for matrix, column in zip(found, columns):
                    np.testing.assert_allclose(matrix[:, k], column / (2 * s), atol=1e-6 * np.abs(matrix).max())

    def test_gravity_can_be_taken_away(self):
        model = twinarm.load(DOUBLE_PENDULUM)
        model.gravity = [0, 0, 0]
        np.testing.assert_array_equal(twinarm.rnea(model, [1, 0.5], [0, 0], [0, 0]), [0, 0])
        np.testing.assert_array_equal(model.gravity, [0, 0, 0])


class EveryJoint(ProgramTest):
    def setUp(self):
        super().setUp()
        self.model = twinarm.load(self.write("all.urdf", every_joint()), floating=True)
        self.q, self.qd, self.third = states(self.model, 12)

    def test_inverse_dynamics_gives_back_the_force_that_forward_dynamics_was_given(self):
        qdd = twinarm.aba(self.model, self.q, self.qd, self.third)
        tau = twinarm.rnea(self.model, self.q, self.qd, qdd)
        np.testing.assert_allclose(tau, self.third, atol=1e-9)

    def test_the_mass_matrix_is_symmetric_and_maps_accelerations_to_forces(self):
        M = twinarm.crba(self.model, self.q)
        np.testing.assert_array_equal(M, M.transpose(0, 2, 1))
        still = np.zeros(self.model.nv)
        for n in range(len(self.q)):
            self.assertGreater(np.linalg.eigvalsh(M[n]).min(), 0)
            change = (twinarm.rnea(self.model, self.q[n], still, self.third[n])
                      - twinarm.rnea(self.model, self.q[n], still, still))
            np.testing.assert_allclose(M[n] @ self.third[n], change, atol=1e-11)
        np.testing.assert_allclose(twinarm.minv(self.model, self.q) @ M,
                                   np.broadcast_to(np.eye(self.model.nv), M.shape), atol=1e-9)

    def test_many_rows_in_one_call_have_the_bits_of_as_many_calls(self):
        for function, arguments in ((twinarm.aba, (self.q, self.qd, self.third)),
                                    (twinarm.rnea, (self.q, self.qd, self.third)),
                                    (twinarm.crba, (self.q,)), (twinarm.minv, (self.q,)),
                                    (twinarm.aba_derivatives, (self.q, self.qd, self.third))):
            together = function(self.model, *arguments)
            for n in range(len(self.q)):
                one = function(self.model, *(a[n] for a in arguments))
                if isinstance(one, tuple):
                    np.testing.assert_array_equal([matrix[n] for matrix in together], one)
                else:
                    np.testing.assert_array_equal(together[n], one)

    def test_one_vector_goes_with_all_rows_and_out_is_filled_and_given_back(self):
        out = np.empty((12, self.model.nv))
        given = twinarm.aba(self.model, self.q, self.qd[3], tau=self.third, out=out)
        self.assertIs(given, out)
        np.testing.assert_array_equal(out[5], twinarm.aba(self.model, self.q[5], self.qd[3], self.third[5]))
        M = np.empty((self.model.nv, self.model.nv))
        self.assertIs(twinarm.crba(self.model, self.q[0], M), M)

    def test_lists_integers_and_arrays_with_gaps_are_taken_like_any_others(self):
        q = self.q[0]
        wide = np.zeros((self.model.nv, 2))
        wide[:, 0] = self.third[0]
        np.testing.assert_array_equal(twinarm.aba(self.model, list(q), [0] * self.model.nv, wide[:, 0]),
                                      twinarm.aba(self.model, q, np.zeros(self.model.nv), self.third[0]))
        np.testing.assert_array_equal(twinarm.rnea(self.model, q, np.ones(self.model.nv, dtype=int), self.third[0]),
                                      twinarm.rnea(self.model, q, np.ones(self.model.nv), self.third[0]))

    def test_the_jacobian_of_a_point_maps_velocities_and_carries_forces_to_joints(self):
        point = [0.3, -0.1, 0.2]
        X = twinarm.poses(self.model, self.q[0])
        V = twinarm.velocities(self.model, self.q[0], self.qd[0])
        wrench = np.array([0.3, -1, 0.5, 2, -0.7, 0.4])  # in link axes about the link's origin
        still = np.zeros(self.model.nv)
        for i, body in enumerate(self.model.bodies[1:], 1):
            J = twinarm.jacobian(self.model, self.q[0], body, point)
            R = X[i, :3, :3]
            w, v = V[i, :3], V[i, 3:]
            np.testing.assert_allclose(J @ self.qd[0], np.concatenate([w, v + np.cross(w, R @ point)]), atol=1e-12)
            f_ext = np.zeros((len(self.model.bodies), 6))
            f_ext[i] = wrench
            at_origin = twinarm.jacobian(self.model, self.q[0], body)
            world = np.concatenate([R @ wrench[:3], R @ wrench[3:]])
            pushed = (twinarm.rnea(self.model, self.q[0], still, still)
                      - twinarm.rnea(self.model, self.q[0], still, still, f_ext=f_ext))
            np.testing.assert_allclose(pushed, at_origin.T @ world, atol=1e-11)
            change = (twinarm.aba(self.model, self.q[0], still, still, f_ext)
                      - twinarm.aba(self.model, self.q[0], still, still))
            np.testing.assert_allclose(twinarm.crba(self.model, self.q[0]) @ change, pushed, atol=1e-9)

    def test_momentum_is_that_of_the_centre_of_mass_and_energy_that_of_the_mass_matrix(self):
        q, qd, h = self.q[0], self.qd[0], 1e-5
        mass, p = twinarm.mass_and_com(self.model, q)
        six = twinarm.momentum(self.model, q, qd)
        places = []
        for direction in (1, -1):  # with its velocities turned round it goes back in time
            moved = twinarm.Simulation(self.model, q, direction * qd, integrator="rk4", h=h)
            moved.step()
            places.append(twinarm.mass_and_com(self.model, moved.q)[1])
        np.testing.assert_allclose(six[3:], mass * (places[0] - places[1]) / (2 * h), rtol=1e-7)
        T, V = twinarm.energy(self.model, q, qd)
        self.assertAlmostEqual(T, qd @ twinarm.crba(self.model, q) @ qd / 2, places=10)
        self.assertAlmostEqual(V, mass * 9.81 * p[2], places=10)


class LikeTheProgram(ProgramTest):
    def test_the_puma_has_the_bits_of_twinarm_dynamics(self):
        model = twinarm.load(PUMA)
        for n, (q, qd, third) in enumerate(zip(*states(model, 3, seed=7))):
            names = [j for j in model.joints if j in model.q_of]
            by_joint = lambda values: dict(zip(names, values))
            state = self.write(f"{n}.json", json.dumps(
                {"q": by_joint(q), "qd": by_joint(qd), "tau": by_joint(third), "qdd": by_joint(third)}))
            reported = program("dynamics", PUMA, "--state", state)
            still = np.zeros(model.nv)
            bare = program("dynamics", PUMA, "--state", state, "--no-friction")
            found = {
                "mass_matrix": twinarm.crba(model, q), "bias": twinarm.rnea(model, q, qd, still),
                "gravity": twinarm.rnea(model, q, still, still),
                "kinetic_energy": twinarm.energy(model, q, qd)[0],
                "potential_energy": twinarm.energy(model, q, qd)[1],
                "mass": twinarm.mass_and_com(model, q)[0], "com": twinarm.mass_and_com(model, q)[1],
                "angular_momentum": twinarm.momentum(model, q, qd)[:3],
                "linear_momentum": twinarm.momentum(model, q, qd)[3:]}
            for key, value in found.items():
                np.testing.assert_array_equal(value, reported[key], key)
            np.testing.assert_array_equal(twinarm.forward_dynamics(model, q, qd, third), list(reported["qdd"].values()))
            np.testing.assert_array_equal(twinarm.aba(model, q, qd, third), list(bare["qdd"].values()))
            np.testing.assert_array_equal(twinarm.rnea(model, q, qd, third), list(bare["tau_inverse"].values()))
            X = twinarm.poses(model, q)
            for link in reported["links"] if isinstance(reported["links"], list) else []:
                i = model.bodies.index(link["name"])
                np.testing.assert_allclose(X[i, :3, 3], link["position"], atol=1e-14)


if __name__ == "__main__":
    main()
