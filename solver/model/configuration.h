// The configuration q on the joints' groups: q exp(theta) is the mechanism moved by theta, one
// number per velocity, joint by joint: a sum for angles and lengths, a product of rotations for
// spherical and free joints.
#pragma once

#include <vector>

#include "solver/model/model.h"

namespace twinarm {

// q_out = q exp(shift), joint by joint; shift has one number per velocity. q_out may be q.
void integrate_coordinates(const Model<double>& model, const std::vector<double>& q,
                           const std::vector<double>& shift, std::vector<double>& q_out);

// d theta/dt for q(t) = q(0) exp(theta(t)) and velocity qd, joint by joint.
void shift_rate(const Model<double>& model, const std::vector<double>& theta,
                const std::vector<double>& qd, std::vector<double>& rate);

// |q| by velocity, to which a relative tolerance refers: 0 for the three of a rotation.
void coordinate_sizes(const Model<double>& model, const std::vector<double>& q,
                      std::vector<double>& size);

// q as files and users have it, with State::prescribed: joint i begins at iq[i] + ip[i], and of a
// prescribed joint velocity and acceleration follow the pose.
std::vector<double> q_with_prescribed(const Model<double>& model, const State<double>& x);
void set_q_with_prescribed(const Model<double>& model, const std::vector<double>& q,
                           State<double>& x);

}  // namespace twinarm
