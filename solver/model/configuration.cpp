#include "solver/model/configuration.h"

#include <algorithm>
#include <cmath>

#include "solver/model/joint_slice.h"

namespace twinarm {

void integrate_coordinates(const Model<double>& model, const std::vector<double>& q,
                           const std::vector<double>& delta, std::vector<double>& q_out) {
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    visit_joint(model, i, [&](auto joint) {
      joint.integrate(q.data() + model.iq[i], delta.data() + model.iv[i],
                      q_out.data() + model.iq[i]);
    });
}

void tangent_rate(const Model<double>& model, const std::vector<double>& theta,
                  const std::vector<double>& qd, std::vector<double>& rate) {
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    visit_joint(model, i, [&](auto joint) {
      const std::size_t iv = model.iv[i];
      store(joint.dexpinv(slice<joint.nv>(theta, iv), slice<joint.nv>(qd, iv)), rate, iv);
    });
}

void coordinate_sizes(const Model<double>& model, const std::vector<double>& q,
                      std::vector<double>& size) {
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    visit_joint(model, i, [&](auto joint) {
      const std::size_t iq = model.iq[i], iv = model.iv[i];
      for (std::size_t c = 0; c < joint.nv; ++c)
        size[iv + c] = joint.quaternion < 0 ? std::abs(q[iq + c])
                       : c < 3              ? 0.0
                                            : std::abs(q[iq + c - 3]);
    });
}

std::vector<double> q_with_prescribed(const Model<double>& model, const State<double>& x) {
  std::vector<double> all(model.nq + model.np);
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    visit_joint(model, i, [&](auto joint) {
      double* to = all.data() + model.iq[i] + model.ip[i];
      std::copy_n(x.q.data() + model.iq[i], joint.nq, to);
      if constexpr (requires { joint.np; })
        std::copy_n(x.prescribed.data() + model.ip[i], joint.np, to + joint.nq);
    });
  return all;
}

void set_q_with_prescribed(const Model<double>& model, const std::vector<double>& q,
                           State<double>& x) {
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    visit_joint(model, i, [&](auto joint) {
      const double* from = q.data() + model.iq[i] + model.ip[i];
      std::copy_n(from, joint.nq, x.q.data() + model.iq[i]);
      if constexpr (requires { joint.np; })
        std::copy_n(from + joint.nq, joint.np, x.prescribed.data() + model.ip[i]);
    });
}

}  // namespace twinarm
