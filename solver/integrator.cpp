#include "solver/integrator.h"

#include "solver/slice.h"

namespace twinarm {

void integrate_coordinates(const Model<double>& model, const std::vector<double>& q,
                           const std::vector<double>& shift, std::vector<double>& q_out) {
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    visit_joint<double>(model.joint[i], [&](auto joint) {
      joint.integrate(q.data() + model.iq[i], shift.data() + model.iv[i],
                      q_out.data() + model.iq[i]);
    });
}

void shift_rate(const Model<double>& model, const std::vector<double>& theta,
                const std::vector<double>& qd, std::vector<double>& rate) {
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    visit_joint<double>(model.joint[i], [&](auto joint) {
      const std::size_t iv = model.iv[i];
      store(joint.dexpinv(slice<joint.nv>(theta, iv), slice<joint.nv>(qd, iv)), rate, iv);
    });
}

}  // namespace twinarm
