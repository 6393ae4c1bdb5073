// Named forces of one step of a scene.

#include "app/inspect/report/inspect_output.h"
#include "app/scene/forces/add_contacts.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {
namespace {

using Index = Eigen::Index;

Index index(std::size_t i) {
  return static_cast<Index>(i);
}

}  // namespace

class SceneInspector::FirstStep {
 public:
  FirstStep(SimulateInput& input, double h, const std::vector<NamedSource>& others,
            Integrator of_run)
      : input_(input),
        model_(input.robot.model),
        h_(h),
        others_(others),
        at_start_(input.robot.state),
        sim_(model_, input.robot.state.x, {.at_instant = true}),
        given_(input.robot),
        k_(model_) {
    sim_.add(given_);
    for (std::size_t c = 0; c < input.couplings->size(); ++c)
      if (ForceSource* source = input.couplings->source(c)) sim_.add(*source);
    for (const NamedSource& other : others_) sim_.add(*other.source);
    for (const SceneMotion& motion : input.scene->motions) sim_.prescribe(motion.body, motion.law);
    sim_.set_integrator(of_run);
    contacts_.emplace(*input.scene, sim_);
    sim_.set_integrator(Integrator::semi_implicit);
  }

  Inspected look(StateArchive* memory, const State<double>* x) {
    if (memory) {
      sim_.serialize(*memory);
      if (x && x->t != sim_.state().t) sim_.set_state(*x);
      input_.robot.state = at_start_;
      set_pose(input_.robot, sim_.state());
    }
    unknowns_ = {};
    Inspected inspected;
    inspected.warnings = input_.robot.warnings;
    x_ = sim_.state();
    const StepReport report = sim_.step(h_);
    inspected.qdd_of_step = sim_.mechanism().w.qdd;
    if (sim_.has_constrained_steps() && sim_.constraints().report().impacts > 0) {
      for (std::size_t dof = 0; dof < model_.nv; ++dof)
        x_.qd[dof] = sim_.state().qd[dof] - h_ * inspected.qdd_of_step[dof];
      inspected.warnings.emplace_back(
          "impact at the start of the step: velocities and forces are those after it");
    }
    if (!report.ok()) inspected.warnings.emplace_back("implicit step did not converge");
    forward_kinematics(model_, x_, k_);
    inspected.x = x_;
    actors_ = given_actors(input_.robot, x_);
    add_couplings();
    add_others();
    add_damping();
    const bool constrained = sim_.has_constrained_steps();
    add_by_joint(model_,
                 constrained ? sim_.constraints().coulomb_torque()
                             : sim_.mechanism().dynamics.torques().coulomb,
                 "joint/", "/friction", actors_);
    find_constraint_force(constrained);
    add_contacts();
    add_limits();
    add_bilateral();
    unknowns_.mark(actors_);
    inspected.actors = std::move(actors_);
    inspected.loops = sim_.mechanism().dynamics.bilateral().loops().loops();
    return inspected;
  }

 private:
  void add_couplings() {
    for (std::size_t c = 0; c < input_.couplings->size(); ++c) {
      ForceSource* source = input_.couplings->source(c);
      if (!source) continue;  // a further component of the coupling before
      Forces<double> added(model_);
      source->add_forces(x_, k_, added);
      const SceneCoupling& spec = input_.couplings->spec(c);
      actors_.push_back(actor_of("coupling/" + spec.coupling, added));
      actors_.back().is_interaction = true;
      if (spec.type == CouplingDescription::Type::linear)
        actors_.back().point_W = k_.position(spec.spring.body, spec.spring.p_L);
    }
  }
  void add_others() {
    for (const NamedSource& other : others_) {
      Forces<double> added(model_);
      other.source->add_forces(x_, k_, added);
      AppliedForce actor = actor_of(other.name, added);
      if (actor.bodies.empty() && actor.joints.empty()) continue;
      actors_.push_back(std::move(actor));
      if (other.at) actors_.back().point_W = k_.position(other.at->first, other.at->second);
    }
  }
  // Implicit: at the end of the step, h b is an armature.
  void add_damping() {
    for (std::size_t i = 1; i < model_.parent.size(); ++i) {
      AppliedForce actor{"joint/" + model_.joint_name[i] + "/damping", {}, {}};
      for (std::size_t dof = model_.iv[i]; dof < model_.iv[i] + model_.dofs(i); ++dof)
        if (const double b = model_.damping[dof]; b != 0)
          actor.joints.push_back({dof, -b * x_.qd[dof], h_ * b});
      if (!actor.joints.empty()) actors_.push_back(std::move(actor));
    }
  }
  // Of a contact between bodies a and b: three components, or one along the force if it slides, as
  // friction is then a function of the normal force; none of a compliant one. Sticking joint
  // friction and rolling moments are left out.
  void add_unknowns(const ContactPoint& p, int a, int b) {
    constexpr double kSliding = 1e-4;  // [m/s]
    if (input_.scene->description.contact == ContactMode::compliant) return;
    const Vector3 p_W = p.contact.p_WC;
    const Eigen::Matrix3Xd J =
        point_jacobian(model_, k_, b, p_W) - point_jacobian(model_, k_, a, p_W);
    const Vector3 v = k_.velocity(b, p_W) - k_.velocity(a, p_W), n = p.contact.n_W;
    if ((v - n.dot(v) * n).norm() > kSliding)
      unknowns_.add(actors_.size(), J.transpose() * p.force_W.normalized());
    else
      unknowns_.add(actors_.size(), J.transpose());
  }

  // Generalised force of all constraints; contacts and limits are subtracted as they are added.
  void find_constraint_force(bool constrained) {
    rest_ = Eigen::VectorXd::Zero(index(model_.nv));
    for (std::size_t dof = 0; dof < model_.nv; ++dof)
      rest_[index(dof)] = constrained ? sim_.constraints().constraint_force()[dof]
                                      : sim_.mechanism().dynamics.torques().mimic[dof] +
                                            sim_.mechanism().dynamics.torques().loop[dof];
  }

  void add_wrench(AppliedForce& actor, int body, const Vector3& p_W, const Vector3& force,
                  const Vector3& torque) {
    if (body <= 0) return;
    const Wrench wrench{static_cast<std::size_t>(body), false, p_W, force, torque};
    actor.bodies.push_back({wrench.body, in_body_axes(wrench, k_), {}});
    for_each_dof_below(model_, k_, body,
                       [&](std::size_t dof, const Vector3& w, const Vector3& v, const Vector3& o) {
                         rest_[index(dof)] -= w.dot(torque + (p_W - o).cross(force)) + v.dot(force);
                       });
  }

  void add_contacts() {
    const ContactConstraints* all = contacts_->contacts();
    if (!all) return;
    const std::vector<char> moved = bodies_with_dofs(model_);
    const auto moves = [&](int body) { return moved[static_cast<std::size_t>(body)] != 0; };
    std::map<std::pair<int, int>, int> count, number;
    const auto is_active = [](const ContactPoint& p) {
      return !p.force_W.isZero(0) || !p.couple_W.isZero(0);
    };
    for (const ContactPoint& p : all->points())
      if (is_active(p)) ++count[{p.contact.a, p.contact.b}];
    for (const ContactPoint& p : all->points()) {
      if (!is_active(p)) continue;
      const std::pair pair(p.contact.a, p.contact.b);
      const ContactGeometry &a = all->bodies().geometry(pair.first),
                            &b = all->bodies().geometry(pair.second);
      std::string name = "contact/" + a.name + "-" + b.name;
      if (count[pair] > 1) name += "/" + std::to_string(++number[pair]);
      AppliedForce actor{std::move(name), {}, {}};
      // A gap that closes within the step is closed by the body that can move.
      const Vector3 half = 0.5 * std::max(0.0, -p.contact.depth) * p.contact.n_W;
      const Vector3 on_b = p.contact.p_WC + (moves(a.body) ? Vector3::Zero() : half);
      const Vector3 on_a = p.contact.p_WC - (moves(b.body) ? Vector3::Zero() : half);
      actor.is_interaction = true;
      actor.point_W = p.contact.p_WC;
      actor.normal_W = p.contact.n_W;
      add_wrench(actor, b.body, on_b, p.force_W, p.couple_W);
      add_wrench(actor, a.body, on_a, -p.force_W, -p.couple_W);
      add_unknowns(p, a.body, b.body);
      actors_.push_back(std::move(actor));
    }
  }
  void add_limits() {
    if (!contacts_->limits()) return;
    for (const JointLimits::Limit& limit : contacts_->limits()->limits()) {
      if (limit.force == 0) continue;
      const auto body = static_cast<std::size_t>(limit.body);
      unknowns_.add(actors_.size(),
                    Eigen::VectorXd::Unit(index(model_.nv), index(model_.iv[body])));
      actors_.push_back(
          {"joint/" + model_.joint_name[body] + "/limit", {}, {{model_.iv[body], limit.force, 0}}});
      rest_[index(model_.iv[body])] -= limit.force;
    }
  }

  // The rest are loops and mimic joints: A^T lambda = rest, lambda of minimum norm.
  void add_bilateral() {
    LoopClosures loops(model_, sim_.mechanism().dynamics.bilateral().loops().loops());
    const std::size_t mimics = model_.mimics.size();
    if (!loops.any() && mimics == 0) return;
    if (loops.any()) loops.evaluate(x_, k_);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(index(loops.rows() + mimics), index(model_.nv));
    if (loops.any()) A.topRows(index(loops.rows())) = loops.J();
    for (std::size_t m = 0; m < mimics; ++m) {
      const Mimic& mimic = model_.mimics[m];
      A(index(loops.rows() + m), index(mimic.follower)) += 1;
      A(index(loops.rows() + m), index(mimic.leader)) -= mimic.ratio;
    }
    const Eigen::VectorXd lambda = min_solution(A.transpose(), rest_, 1e-9);
    const Eigen::VectorXd of_loops = lambda.head(index(loops.rows()));
    for (std::size_t l = 0; l < loops.loops().size(); ++l) {
      const Index rows = index(facts_of(loops.loops()[l].type).rows);
      unknowns_.add(actors_.size(), A.middleRows(index(loops.first_row(l)), rows).transpose());
      add_loop(loops, l, of_loops);
    }
    unknowns_.add(std::nullopt, A.bottomRows(index(mimics)).transpose());
    std::vector<double> tau(model_.nv);
    for (std::size_t m = 0; m < mimics; ++m) {
      tau[model_.mimics[m].follower] += lambda[index(loops.rows() + m)];
      tau[model_.mimics[m].leader] -= model_.mimics[m].ratio * lambda[index(loops.rows() + m)];
    }
    add_by_joint(model_, tau, "joint/", "/mimic", actors_);
  }
  void add_loop(const LoopClosures& loops, std::size_t l, const Eigen::VectorXd& lambda) {
    const LoopClosure& loop = loops.loops()[l];
    AppliedForce actor{"constraint/" + loop.name, {}, {}};
    actor.is_interaction = true;
    if (facts_of(loop.type).ends != LoopBetween::bodies) {
      const std::size_t row = loops.first_row(l);
      for (const std::size_t dof : loops.dofs_of(row))
        actor.joints.push_back({dof, loops.J()(index(row), index(dof)) * lambda[index(row)], 0});
    } else {
      const LoopWrench on_a = loops.wrench(l, lambda);
      const auto a = static_cast<std::size_t>(loop.body_a),
                 b = static_cast<std::size_t>(loop.body_b);
      const Vector3 C_b = k_.X_WL[b] * loop.X_LbC.p;
      const Vector3 C_a = loop.type == LoopType::distance ? k_.X_WL[a] * loop.X_LaC.p : C_b;
      actor.point_W = C_b;
      add_wrench(actor, loop.body_a, C_a, on_a.force, on_a.couple);
      add_wrench(actor, loop.body_b, C_b, -on_a.force, -on_a.couple);
    }
    actors_.push_back(std::move(actor));
  }

  SimulateInput& input_;
  const Model<double>& model_;
  double h_;
  std::vector<NamedSource> others_;
  const GivenState at_start_;
  Simulation sim_;
  GivenForces given_;
  std::optional<SceneContacts> contacts_;
  State<double> x_;  // at which the forces act
  Kinematics k_;
  std::vector<AppliedForce> actors_;
  Eigen::VectorXd rest_;  // constraint force not yet assigned, by velocity
  ConstraintUnknowns unknowns_;
};

SceneInspector::SceneInspector(SimulateInput& input, double h,
                               const std::vector<NamedSource>& others, Integrator of_run)
    : step_(std::make_unique<FirstStep>(input, h, others, of_run)) {}
SceneInspector::~SceneInspector() = default;
Inspected SceneInspector::look(StateArchive* memory, const State<double>* x) {
  return step_->look(memory, x);
}

}  // namespace twinarm
