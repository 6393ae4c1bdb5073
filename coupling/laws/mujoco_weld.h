// A weld as MuJoCo makes a mocap weld: a soft constraint that is given in accelerations (its
// documentation, "Computation", "Soft constraint model"). Per direction, with the offset r = x -
// x_K and the velocity v of the link's point (or its turn and w), the constraint has a reference
//
//   a_ref = -b_ref v - k_ref r,   b_ref = 2/(d T),   k_ref = 1/(d T^2 z^2)
//
// of time constant T, damping ratio z ("solref"), and impedance d in (0, 1) ("solimp", taken as
// constant: then d(r) = dmax). The velocity is the link's own: the target's is not seen, so a
// target at constant speed V is followed k_ref r = b_ref V behind,
//
//   lag = 2 V T z^2        (2 V T at z = 1).
//
// The constraint's force f solves (A + R) f = a_ref - a_0, R = (1 - d)/d A_0; with a = a_0 + A f,
// the acceleration that comes of it, this is
//
//   f = m_R (a_ref - a),   m_R = 1/R = d/(1 - d) m_0,     and where A = A_0:
//   a = (1 - d) a_0 + d a_ref.
//
// So the weld is a spring-damper k = m_R k_ref, b = m_R b_ref with a damper that does not see the
// target, and an inertia m_R that opposes the acceleration: the weightless particle (and flywheel)
// of docs/understand/coupling_laws.md, in O(n), but one that feels velocity products too. All other
// forces are felt (1 - d) as much. m_0 is the effective mass of the link, as MuJoCo takes it: once,
// at the pose that is given, 3/trace(J M^-1 J^T) of its centre of mass, and of its orientation.
//
// MuJoCo's orientation offset is sin(angle/2) about the axis; here it is the rotation vector.
//
// Treatments: explicit (as MuJoCo: r and v at the start of the step, the acceleration that of the
// step); semi-implicit (v at its end), implicit (r and v at its end): m* = m_R + h b + h^2 k. All
// enter the inertia, and go with the semi-implicit integrators only.
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

// The gains of a weld of a link: k = m_R k_ref and so on. Zero in what the link cannot do at x.
// O(n^3); allocates.
Spring weld_spring(std::string name, const Model<double>& model, const State<double>& x, int body,
                   const Vector3& p_L, const SolrefParameters& reference);

}  // namespace twinarm
