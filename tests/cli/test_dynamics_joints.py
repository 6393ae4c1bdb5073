"""`twinarm dynamics`: one body on a joint of every type, against Lagrange's equations."""
import cmath
import math

from program import main
from robot_command import (COM, INERTIA, MASS, RobotCommand, add, cross, dot, joint, link, robot,
                           rotation, scale, symmetric, times, transpose, unit)


class JointsByLagrange(RobotCommand):
    """One body on a joint. The oracle knows only where the body is for given q: Lagrange's equations,
    Jacobians by the complex step and their derivatives by differences."""
    command = "dynamics"
    STEP = 1e-30
    ROOT_XYZ, ROOT_RPY = [0.2, -0.1, 0.4], (0.3, -0.5, 0.9)

    def place(self, local, q):
        """R and p of the body in the world; `local` gives them in the joint's frame."""
        cos, sin = cmath.cos, cmath.sin
        r, p, y = self.ROOT_RPY
        J = times(times(rotation([0, 0, 1], y, cos, sin), rotation([0, 1, 0], p, cos, sin)),
                  rotation([1, 0, 0], r, cos, sin))
        R, t = local(q)
        return times(J, R), add(self.ROOT_XYZ, times(J, t))

    def jacobians(self, local, q):
        """By column: (velocity of the centre of mass, angular velocity), and of the origin."""
        columns = []
        R0 = [[x.real for x in row] for row in self.place(local, q)[0]]
        for k in range(len(q)):
            moved = [x + (1j * self.STEP if i == k else 0) for i, x in enumerate(q)]
            R, p = self.place(local, moved)
            com = add(p, times(R, list(COM)))
            W = times([[x.imag / self.STEP for x in row] for row in R], transpose(R0))
            columns.append(([x.imag / self.STEP for x in com], [W[2][1], W[0][2], W[1][0]],
                            [x.imag / self.STEP for x in p]))
        return columns, R0

    def mass_matrix(self, local, q):
        J, R = self.jacobians(local, q)
        I = times(times(R, symmetric(*INERTIA)), transpose(R))
        return [[MASS * dot(a[0], b[0]) + dot(a[1], times(I, b[1])) for b in J] for a in J]

    def bias(self, local, q, qd):
        n, h = len(q), 1e-4

        def slope(k):  # dM/dq_k, of order 4
            def at(shift):
                return self.mass_matrix(local, [x + (shift if i == k else 0) for i, x in enumerate(q)])
            a, b, c, d = at(-2 * h), at(-h), at(h), at(2 * h)
            return [[(a[i][j] - 8 * b[i][j] + 8 * c[i][j] - d[i][j]) / (12 * h) for j in range(n)] for i in range(n)]
        dM = [slope(k) for k in range(n)]
        J, _ = self.jacobians(local, q)
        return [sum((dM[k][i][j] - dM[i][j][k] / 2) * qd[j] * qd[k]
                    for j in range(n) for k in range(n)) + MASS * 9.81 * J[i][0][2]
                for i in range(n)]

    def check(self, kind, local, q, axis, more=""):
        urdf = robot('<link name="base"/>', link("body"),
                     joint("j", kind, "base", "body", xyz=" ".join(map(str, self.ROOT_XYZ)),
                           rpy=" ".join(map(str, self.ROOT_RPY)),
                           axis=" ".join(map(str, axis)), more=more))
        qd, qdd, tau = ([0.9, -0.6, 1.3][:len(q)], [0.4, 0.7, -0.2][:len(q)], [1.1, -0.3, 0.5][:len(q)])
        state = {"q": q, "qd": qd, "qdd": qdd, "tau": tau}
        answer = self.answer(urdf, state={key: {"j": v[0] if len(v) == 1 else v} for key, v in state.items()})

        def values(key):
            value = answer[key]["j"]
            return value if isinstance(value, list) else [value]
        M, bias = self.mass_matrix(local, q), self.bias(local, q, qd)
        self.close(answer["mass_matrix"], M, 1e-12, kind)
        self.close(answer["bias"], bias, 1e-9, kind)
        self.close(add(times(M, values("qdd")), bias), tau, 1e-9, kind)
        self.close(values("tau_inverse"), add(times(M, qdd), bias), 1e-9, kind)
        J, R = self.jacobians(local, q)
        body = answer["links"]["body"]
        self.close(body["rotation"], R, 1e-12, kind)
        self.close(body["position"], [x.real for x in self.place(local, q)[1]], 1e-12, kind)
        self.close(body["angular_velocity"], add(*[scale(rate, column[1]) for rate, column in zip(qd, J)]), 1e-12, kind)
        self.close(body["linear_velocity"], add(*[scale(rate, column[2]) for rate, column in zip(qd, J)]), 1e-12, kind)

    def test_every_joint_of_one_to_three_coordinates_moves_as_lagrange_says(self):
        n = unit([1, 2, 2])

        def turn(axis, angle):
            return rotation(axis, angle, cmath.cos, cmath.sin)
        # The shortest rotation that takes z to n.
        across = unit(cross([0, 0, 1], n))
        to_n = turn(across, math.acos(n[2]))
        x, y = [row[0] for row in to_n], [row[1] for row in to_n]
        still = turn(n, 0)
        self.check("revolute", lambda q: (turn(n, q[0]), [0, 0, 0]), [0.7], n)
        self.check("prismatic", lambda q: (still, scale(q[0], n)), [0.7], n)
        self.check("screw", lambda q: (turn(n, q[0]), scale(0.3 * q[0] / (2 * math.pi), n)),
                   [2.4], n, '<twinarm pitch="0.3"/>')
        self.check("cylindrical", lambda q: (turn(n, q[0]), scale(q[1], n)), [0.7, 0.4], n)
        self.check("universal", lambda q: (times(turn(n, q[0]), turn(y, q[1])), [0, 0, 0]), [0.7, 0.5], n)
        self.check("planar", lambda q: (turn(n, q[2]), add(scale(q[0], x), scale(q[1], y))), [0.3, -0.6, 0.8], n)

    def test_a_screw_falls_as_its_pitch_lets_it(self):
        m, I, pitch = 2.0, 0.05, 0.1 / (2 * math.pi)
        urdf = robot('<link name="base"/>', link("nut", m, (0, 0, 0), (I, 0, 0, I, 0, I)),
                     joint("screw", "screw", "base", "nut", more='<twinarm pitch="0.1"/>'))
        answer = self.answer(urdf)
        self.close(answer["qdd"]["screw"], -m * 9.81 * pitch / (I + m * pitch ** 2))
        self.close(answer["qdd"]["screw"], -6.1825971606954312)
        self.close(answer["tau_inverse"]["screw"], 0.31226199834629865)


if __name__ == "__main__":
    main()
