// God object: the DVR has the acceleration that moves it to the KVR by the end of the step,
// projected by the contacts (Zilles and Salisbury 1995 for a point; Ortega, Redon, Coquillart 2007
// in six dimensions, after Gauss's principle):
//
//   a_u = ((q_K' - q)/h - qd)/h                 reaches q_K' : qd' = qd + h a_u, q' = q + h qd'
//   min (a - a_u)^T M (a - a_u)  with the contact constraints J a >= ...
//
// tau = ID(q, qd, a_u), O(n), makes a_u the acceleration without contact; the impulses of the rigid
// contacts then change it by M^-1 J^T p, p >= 0: the projection in the metric of M. tau contains
// gravity, damping and joint friction, so only contacts and limits cause a tracking error. There
// are no gains and no stability limit; against an obstacle the torque is M times the remaining
// distance over h^2.
//
// Acts on all joints of a robot (undriven joints would be accelerated by the others), each of one
// degree of freedom, and with semi-implicit Euler only.

#include "coupling/laws/coupling_spec.h"
#include "solver/dynamics/dynamics.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

class GodObject final : public Coupling {
 public:
  // One spring with zero gains for each joint. Throws InputError for joints of several degrees of
  // freedom, and if a joint of the tree is not driven.
  GodObject(const CouplingSpec& spec, const Model<double>& model, TargetRobot& kvr)
      : Coupling(spec, model, kvr), a_u_(model.nv), no_forces_(model.parent.size()), w_(model) {
    check_one_dof();
    check_joints();
  }

  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    const TargetSample& end = kvr_.end();
    for (const Spring& joint : springs_) {
      const auto i = static_cast<std::size_t>(joint.body);
      const std::size_t iq = model_.iq[i], iv = model_.iv[i];
      a_u_[iv] = ((end.x.q[iq] - x.q[iq]) / h_ - x.qd[iv]) / h_;
    }
    rnea(model_, x, a_u_, no_forces_, w_);
    for (std::size_t s = 0; s < springs_.size(); ++s) {
      const auto i = static_cast<std::size_t>(springs_[s].body);
      const std::size_t iv = model_.iv[i];
      SpringState& reading = readings_[s];
      reading.size = w_.tau[iv] + friction(iv, x.qd[iv] + h_ * a_u_[iv]);
      reading.p_K = end.k.X_WL[i].p;
      reading.p_D = k.X_WL[i].p;
      forces.tau[iv] += reading.size;
    }
  }
  bool needs_semi_implicit() const override { return true; }
  JointSpace joint_space(const Kinematics&) const override {  // zero: there is no spring
    return JointSpace(model_.nv);
  }

 private:
  // Reports joints between or beyond driven ones that are not driven.
  void check_joints() const {
    std::vector<char> driven(model_.parent.size(), 0), above(driven);  // above: in a driven branch
    for (const Spring& joint : springs_) driven[static_cast<std::size_t>(joint.body)] = 1;
    DiagnosticList faults;
    const auto fault = [&](std::size_t i) {
      faults.add("coupling '" + name_ + "', joint '" + model_.joint_name[i] + "'",
                 "the joint is not driven, but its neighbours are", "drive all joints of the robot",
                 "coupling.joints");
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
  // Viscous and Coulomb friction at the end of the step; no Coulomb friction at rest, where the
  // solver finds it.
  double friction(std::size_t dof, double qd_end) const {
    const double dry = qd_end > 0   ? model_.coulomb_plus[dof]
                       : qd_end < 0 ? -model_.coulomb_minus[dof]
                                    : 0;
    return model_.damping[dof] * qd_end + dry;
  }

  std::vector<double> a_u_;  // by velocity
  std::vector<Force<double>> no_forces_;
  Workspace<double> w_;
};

}  // namespace

std::vector<Spring> god_object_joints(const Model<double>& model, int first_body, int last_body) {
  std::vector<Spring> joints;
  for (int body = first_body; body <= last_body; ++body) {
    const auto i = static_cast<std::size_t>(body);
    if (model.dofs(i) > 0) joints.push_back({model.joint_name[i], body});
  }
  return joints;
}

CouplingFacts god_object_coupling() {
  return {.name = "god-object",
          .order = 7,
          .discretizations = CouplingFacts::Discretizations::own,
          .gains = CouplingFacts::Gains::none,
          .at_joint = true,
          .is_spring_damper = false,
          .step_law = StepLaw::god_object,
          .make = make_law<GodObject>};
}

}  // namespace twinarm
