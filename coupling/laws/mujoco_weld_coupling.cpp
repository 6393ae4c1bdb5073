#include "coupling/laws/mujoco_weld.h"

#include <utility>

#include "coupling/laws/spring_damper.h"
#include "solver/dynamics/dynamics.h"
#include "solver/forces/spring.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

// 3/trace(J M^-1 J^T); 0 if the link cannot move.
double effective_mass(const Eigen::MatrixXd& inverse_M, const Eigen::Matrix3Xd& J) {
  const double trace = (J * inverse_M * J.transpose()).trace();
  return trace > 0 ? 3 / trace : 0;
}

// Angular acceleration of the link and acceleration of its point p_W at qdd = 0, from the spatial
// a_bias, which includes gravity as an upward acceleration of the base.
struct BiasAcceleration {
  Vector3 angular, point;
};
BiasAcceleration bias_acceleration(const Model<double>& model, const Kinematics& k, int body,
                                   const Vector3& p_W) {
  const auto i = static_cast<std::size_t>(body);
  const Vector3 angular = k.R_WB[i] * to_eigen(k.a_bias[i].w);
  const Vector3 origin = k.R_WB[i] * to_eigen(k.a_bias[i].v) + to_eigen(model.gravity);
  return {angular,
          origin + angular.cross(p_W - k.X_WL[i].p) + k.w_WL[i].cross(k.velocity(body, p_W))};
}

class MujocoWeld final : public Coupling {
 public:
  // m_R = b/b_ref of each spring. Throws InputError for invalid SolrefParameters.
  MujocoWeld(const CouplingSpec& spec, const Model<double>& model, TargetRobot& kvr)
      : Coupling(spec, model, kvr),
        discretization_(spec.discretization),
        damping_(spec.reference.damping()) {
    const SolrefParameters& reference = spec.reference;
    const auto good = [](double x) { return x > 0 && std::isfinite(x); };
    DiagnosticList faults;
    const auto check = [&](bool valid, const char* what, double value, const char* allowed) {
      if (!valid)
        faults.add("coupling '" + name_ + "', " + what,
                   short_number_text(value) + " is not allowed, " + allowed, "give another value",
                   "coupling.weld");
    };
    check(good(reference.time_constant), "time constant", reference.time_constant,
          "must be positive");
    check(good(reference.damping_ratio), "damping ratio", reference.damping_ratio,
          "must be positive");
    check(reference.impedance > 0 && reference.impedance < 1, "impedance", reference.impedance,
          "must lie between 0 and 1");
    faults.check();
    readings_.resize(2 * springs_.size());  // forces, then torques
  }

  // Forces at qdd = 0: minus m_R times the bias acceleration.
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    DiscretizationTerms terms = discretization_terms(discretization_, kvr_, x.t, h_);
    terms.h_b += 1 / damping_;  // m* = m_R + h b + h^2 k
    terms.is_relative_damper = false;
    for (std::size_t s = 0; s < springs_.size(); ++s) {
      const Spring& spring = springs_[s];
      SpringState &force = readings_[s], &torque = readings_[springs_.size() + s];
      apply_point_spring(spring, terms, k, force, forces);
      apply_torsional_spring(spring.body, spring.k_rotational, spring.b_rotational, terms, k,
                             torque, forces);
      const BiasAcceleration bias = bias_acceleration(model_, k, spring.body, force.p_D);
      force.force_W -= spring.b / damping_ * bias.point;
      torque.force_W -= spring.b_rotational / damping_ * bias.angular;
      force.size = force.force_W.norm();
      torque.size = torque.force_W.norm();
      add_point_force(k, spring.body, force.p_D, force.force_W, forces);
      add_couple(k, spring.body, torque.force_W, forces);
    }
  }
  bool needs_semi_implicit() const override { return true; }
  // With e = q_K - q_D: (M + m_R J^T J) e'' + B e' + K e = ... ...
  JointSpace joint_space(const Kinematics& k) const override {
    return joint_space_of_frames(model_, k, springs_);
  }

 private:
  Discretization discretization_;
  double damping_;  // b_ref
};

}  // namespace

Spring weld_spring(std::string name, const Model<double>& model, const State<double>& x, int body,
                   const Vector3& p_L, const SolrefParameters& reference) {
  const auto i = static_cast<std::size_t>(body);
  const Kinematics k = kinematics_at(model, x);
  const Eigen::MatrixXd inverse_M = inverse_of(mass_matrix(model, x));
  const Vector3 com =
      model.I[i].m > 0 ? Vector3(to_eigen(model.I[i].h) / model.I[i].m) : Vector3(Vector3::Zero());
  const Vector3 com_W = k.X_WL[i].p + k.R_WB[i] * com;
  const double part = reference.impedance / (1 - reference.impedance);
  const double mass = part * effective_mass(inverse_M, point_jacobian(model, k, body, com_W));
  const double inertia = part * effective_mass(inverse_M, rotation_jacobian(model, k, body));
  const double k_ref = reference.stiffness(), b_ref = reference.damping();
  return {std::move(name), body, p_L, mass * k_ref, mass * b_ref, inertia * k_ref, inertia * b_ref};
}

CouplingFacts mujoco_weld_coupling() {
  return {.name = "weld",
          .order = 4,
          .discretizations = CouplingFacts::Discretizations::all,
          .gains = CouplingFacts::Gains::reference,
          .at_point = true,
          .make = make_law<MujocoWeld>};
}

}  // namespace twinarm
