// Configuration q on the Lie groups of the joints. q exp(theta), with nv tangent coordinates theta:
// a sum for angles and lengths, a product of rotations for spherical and free joints.
#pragma once

#include <vector>

#include "solver/model/model.h"

namespace twinarm {

// q_out = q exp(delta); q_out may be q.
void integrate_coordinates(const Model<double>& model, const std::vector<double>& q,
                           const std::vector<double>& delta, std::vector<double>& q_out);

// d theta/dt for q(t) = q(0) exp(theta(t)) and velocity qd.
void tangent_rate(const Model<double>& model, const std::vector<double>& theta,
                  const std::vector<double>& qd, std::vector<double>& rate);

// By velocity: |q| as reference of a relative tolerance; 0 for the three of a rotation.
void coordinate_sizes(const Model<double>& model, const std::vector<double>& q,
                      std::vector<double>& size);

// q in the layout of files, including State::prescribed: joint i begins at iq[i] + ip[i]; velocity
// and acceleration of a prescribed joint follow its pose.
std::vector<double> q_with_prescribed(const Model<double>& model, const State<double>& x);
void set_q_with_prescribed(const Model<double>& model, const std::vector<double>& q,
                           State<double>& x);

}  // namespace twinarm
