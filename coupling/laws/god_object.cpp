#include "coupling/laws/god_object.h"

#include <algorithm>
#include <utility>

#include "solver/dynamics/dynamics.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

GodObject::GodObject(std::string name, const Model<double>& model, KinematicRobot& kvr,
                     std::vector<Spring> joints)
    : Coupling(std::move(name), model, kvr, std::move(joints)),
      a_u_(model.nv),
      no_forces_(model.parent.size()),
      w_(model) {
  check_one_dof();
  check_joints();
}

// A joint of the same tree that is not driven.
void GodObject::check_joints() const {
  std::vector<char> driven(model_.parent.size(), 0), above(driven);  // above: in a driven branch
  for (const Spring& joint : springs_) driven[static_cast<std::size_t>(joint.body)] = 1;
  FaultList faults;
  const auto fault = [&](std::size_t i) {
    faults.add({"", 0, "coupling '" + name_ + "', joint '" + model_.joint_name[i] + "'",
                "it is left out, but its neighbours are driven", "drive all joints of the robot"});
  };
  for (std::size_t i = 1; i < driven.size(); ++i) {
    const auto parent = static_cast<std::size_t>(model_.parent[i]);
    above[i] = static_cast<char>(above[parent] | driven[i]);
    if (above[i] && !driven[i] && model_.dofs(i) > 0) fault(i);
  }
  std::vector<char> below(driven);
  for (std::size_t i = driven.size(); i-- > 1;) {
    const auto parent = static_cast<std::size_t>(model_.parent[i]);
    if (parent > 0 && below[i]) below[parent] = 1;
    if (below[i] && !above[i] && model_.dofs(i) > 0) fault(i);
  }
  faults.check();
}

void GodObject::begin_step(const Kinematics&, double t, double h) noexcept {
  h_ = h;
  kvr_.begin_step(t, h);
}

// Against damping and dry friction, which the step takes at its end. At rest nothing rubs: friction
// finds what it holds by itself.
double GodObject::friction(std::size_t dof, double qd_end) const {
  const double dry = qd_end > 0   ? model_.coulomb_plus[dof]
                     : qd_end < 0 ? -model_.coulomb_minus[dof]
                                  : 0;
  return model_.damping[dof] * qd_end + dry;
}

void GodObject::add_forces(const State<double>& x, const Kinematics& k,
                           Forces<double>& forces) noexcept {
  const KvrSample& end = kvr_.end();
  for (const Spring& joint : springs_) {
    const auto i = static_cast<std::size_t>(joint.body);
    const std::size_t iq = model_.iq[i], iv = model_.iv[i];
    a_u_[iv] = ((end.x.q[iq] - x.q[iq]) / h_ - x.qd[iv]) / h_;
  }
  rnea(model_, x, a_u_, no_forces_, w_);
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const auto i = static_cast<std::size_t>(springs_[s].body);
    const std::size_t iv = model_.iv[i];
    SpringReading& reading = readings_[s];
    reading.size = w_.tau[iv] + friction(iv, x.qd[iv] + h_ * a_u_[iv]);
    reading.p_K = end.k.X_WL[i].p;
    reading.p_D = k.X_WL[i].p;
    forces.tau[iv] += reading.size;
  }
}

Coupling::JointSpace GodObject::joint_space(const Kinematics&) const {
  return JointSpace(model_.nv);
}

std::vector<Spring> god_object_joints(const Model<double>& model, int first_body, int last_body) {
  std::vector<Spring> joints;
  for (int body = first_body; body <= last_body; ++body) {
    const auto i = static_cast<std::size_t>(body);
    if (model.dofs(i) > 0) joints.push_back({model.joint_name[i], body});
  }
  return joints;
}

}  // namespace twinarm
