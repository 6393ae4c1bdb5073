// The spring-dampers that linear, bushing and weld-like couplings share: at a point of a link, and
// between the orientations of a link. Each fills the reading and adds its weightless inertia
// (solver/forces/spring.h); the force itself is added by the caller, who may hold it.
#pragma once

#include "coupling/laws/coupling.h"
#include "coupling/laws/discretization.h"

namespace twinarm {

// F = k (p_K - p_D - look_ahead v_D) + b (v_K - v_D), and a particle of m*.
void pull_point(const Spring& spring, const TreatmentTerms& terms, const Kinematics& D,
                SpringReading& reading, Forces<double>& forces);
// T = k (log(R_K R_D^T) - look_ahead w_D) + b (w_K - w_D), and a flywheel of m*.
void turn_link(int body, double k, double b, const TreatmentTerms& terms, const Kinematics& D,
               SpringReading& reading, Forces<double>& forces);

// sum of J^T k J and of J^T b J: of springs at points, with J the point's Jacobian; of springs on
// orientations (k_turn, b_turn), with J the rotation's.
Coupling::JointSpace joint_space_of_points(const Model<double>& model, const Kinematics& k,
                                           const std::vector<Spring>& springs);
Coupling::JointSpace joint_space_of_turns(const Model<double>& model, const Kinematics& k,
                                          const std::vector<Spring>& springs);

}  // namespace twinarm
