// A weld like MuJoCo's weld to a mocap body: a soft constraint in accelerations (MuJoCo's
// documentation, "Computation", "Soft constraint model"). Per direction, with r = x - x_K and the
// velocity v of the link's point (or rotation vector and w), the reference acceleration is
//
//   a_ref = -b_ref v - k_ref r,   b_ref = 2/(d T),   k_ref = 1/(d T^2 z^2)
//
// with time constant T, damping ratio z ("solref") and impedance d in (0, 1) ("solimp", constant:
// d(r) = dmax). The damper is absolute, so a target at constant speed V has the tracking error
// k_ref r = b_ref V,
//
//   r = 2 V T z^2        (2 V T at z = 1).
//
// The constraint force f solves (A + R) f = a_ref - a_0, R = (1 - d)/d A_0; with a = a_0 + A f,
//
//   f = m_R (a_ref - a),   m_R = 1/R = d/(1 - d) m_0,     and where A = A_0:
//   a = (1 - d) a_0 + d a_ref.
//
// So the weld is a spring-damper k = m_R k_ref, b = m_R b_ref with an absolute damper and an added
// inertia m_R (docs/understand/coupling_laws.md), O(n), which here also resists velocity-product
// accelerations. The effect of all other forces is reduced to 1 - d. m_0 is the effective mass of
// the link as in MuJoCo: at the given pose, 3/trace(J M^-1 J^T) of its centre of mass and of its
// orientation. MuJoCo's orientation error is sin(angle/2) about the axis, here the rotation vector.
//
// Discretizations: explicit (as MuJoCo: r and v at the start of the step, a of the step);
// semi-implicit (v at its end), implicit (r and v at its end): m* = m_R + h b + h^2 k. All add
// inertia and need a semi-implicit integrator.
#pragma once

#include "coupling/laws/coupling.h"

namespace twinarm {

struct SolrefParameters {
  double time_constant = 0.02;  // T > 0 [s]
  double damping_ratio = 1;     // z > 0
  double impedance = 0.95;      // d in (0, 1)

  double stiffness() const {  // k_ref [1/s^2]
    return 1 / (impedance * time_constant * time_constant * damping_ratio * damping_ratio);
  }
  double damping() const { return 2 / (impedance * time_constant); }  // b_ref [1/s]
};

// The gains k = m_R k_ref, b = m_R b_ref of a weld of a link; zero where the link cannot move at x.
// O(n^3); allocates.
Spring weld_spring(std::string name, const Model<double>& model, const State<double>& x, int body,
                   const Vector3& p_L, const SolrefParameters& reference);

}  // namespace twinarm
