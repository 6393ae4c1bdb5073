#include "app/accounting/momentum_balance.h"

namespace twinarm {

MomentumBalance::MomentumBalance(const RobotInput& input, GivenForces& given,
                                 SceneCouplings* couplings, Integrator integrator,
                                 bool locates_events, const Simulation& simulation,
                                 PosedStates& poses)
    : input_(input),
      given_(given),
      couplings_(couplings),
      integrator_(integrator),
      rule_(locates_events ? Rule::located
            : simulation.has_constrained_steps() || facts_of(integrator).implicit_force
                ? Rule::at_start
                : Rule::integral),
      coupling_count_(couplings ? couplings->size() : 0),
      loop_count_(simulation.mechanism().dynamics.bilateral().loops().loops().size()),
      moved_(bodies_with_dofs(input.model)),
      stabilisation_(loop_count_),
      mimics_(input.model.mimics.size()),
      sleeps_(simulation.constraints().sleep().is_on()),
      start_(simulation.state()),
      now_(start_),
      poses_(poses),
      w_(input.model) {
  at_start_ = contents(moved_, start_);
  find_trees();
  sums_.resize(tree(trees_.size()));
}

// A free joint transmits no force without actuator, damping or friction.
void MomentumBalance::find_trees() {
  const Model<double>& model = input_.model;
  std::vector<char> acts(model.parent.size(), 0);
  const auto& joints = input_.coordinates.all();
  for (std::size_t j = 0; j < joints.size(); ++j)
    acts[joints[j].body] = input_.state.has_tau[j] ? 1 : 0;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    if (!moved_[i] || moved_[static_cast<std::size_t>(model.parent[i])]) continue;
    const std::size_t iv = model.iv[i];
    const bool has_friction = model.damping[iv] != 0 || model.coulomb_plus[iv] != 0;
    if (model.joint[i] == JointType::free && !acts[i] && !has_friction) continue;
    Tree tree{model.joint_name[i], std::vector<char>(model.parent.size(), 0)};
    tree.bodies[i] = 1;
    for (std::size_t b = i + 1; b < tree.bodies.size(); ++b)
      tree.bodies[b] = tree.bodies[static_cast<std::size_t>(model.parent[b])];
    trees_.push_back(std::move(tree));
  }
}

void MomentumBalance::serialize(StateArchive& memory) {
  for (auto* sums : {&sums_, &stabilisation_})
    for (EnergyMomentum& sum : *sums) sum.serialize(memory);
  separation_.serialize(memory);
  limit_separation_.serialize(memory);
  if (sleeps_) sleep_.serialize(memory);
  memory.visit_fixed(mimics_);
  for (State<double>* x : {&start_, &now_}) visit_state(memory, input_.model, *x);
  if (memory.reads()) at_start_ = contents(moved_, start_);
}

void MomentumBalance::add_step(double h, std::span<const double> weights,
                               const std::vector<State<double>>& inner, const Simulation& after,
                               bool by_limits) {
  using Side = SceneCouplings::Side;
  const State<double>& end = after.state();
  if (rule_ == Rule::at_start) {
    State<double> at = integrator_ == Integrator::semi_implicit_xv ? end : now_;
    at.qd = now_.qd;
    add_given(h, at);
    add_coupling_impulses(h, at, end);
    if (!after.has_constrained_steps()) add_loops(h, after.mechanism(), now_.qd, h);
    add_trees(h, after.mechanism(), poses_.at(at));
    add_impacts(after);
  } else if (rule_ == Rule::located) {
    for (const State<double>* x : {static_cast<const State<double>*>(&now_), &end}) {
      add_given(0.5 * h, *x);
      add_couplings(0.5 * h, *x, x == &end ? Side::before : Side::after);
    }
  } else {
    const auto add = [&](const State<double>& x, double weight, Side side) {
      add_given(weight * h, x);
      add_couplings(weight * h, x, side);
      if (trees_.empty() && loop_count_ == 0) return;
      evaluate_at(after, x, copy_);
      add_loops(weight * h, *copy_, x.qd, 0);
      add_trees(weight * h, *copy_, poses_.at(x));
    };
    add(now_, weights.front(), Side::after);
    for (std::size_t s = 0; s < inner.size(); ++s) add(inner[s], weights[s + 1], Side::after);
    add(end, weights.back(), Side::before);
  }
  const ConstraintWork& account = *after.mechanism().account;
  if (rule_ != Rule::located)
    for (const ConstraintWork::Projection& projection : account.projections())
      for (std::size_t t = 0; t < trees_.size(); ++t)
        sums_[tree(t)] +=
            contents(trees_[t].bodies, projection.to) - contents(trees_[t].bodies, projection.from);
  for (std::size_t l = 0; l < loop_count_; ++l) {
    sums_[loop(l)] += account.loops()[l];
    stabilisation_[l] += account.stabilisation()[l];
  }
  for (std::size_t i = 0; i < mimics_.size(); ++i) mimics_[i] += account.mimics()[i];
  (by_limits ? limit_separation_ : separation_) += account.separation();
  sleep_ += account.sleep();
  now_ = end;
}

EnergyMomentum MomentumBalance::contents(const std::vector<char>& of,
                                         const State<double>& x) const {
  return energy_and_momentum_of(input_.model, of, x, w_);
}

void MomentumBalance::add_given(double part, const State<double>& x) {
  const Model<double>& model = input_.model;
  const Kinematics& k = poses_.at(x);
  const Vector3 g = to_eigen(model.gravity);
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    if (!moved_[i]) continue;
    const Vector3 first_moment = model.I[i].m * k.X_WL[i].p + k.R_WB[i] * to_eigen(model.I[i].h);
    sums_[0].impulse += part * model.I[i].m * g;
    sums_[0].moment += part * first_moment.cross(g);
    if (rule_ != Rule::located) continue;
    for (std::size_t t = 0; t < trees_.size(); ++t)  // rows() adds the change of momentum
      if (trees_[t].bodies[i]) {
        sums_[tree(t)].impulse -= part * model.I[i].m * g;
        sums_[tree(t)].moment -= part * first_moment.cross(g);
      }
  }
  for (std::size_t i = 0; i < given_.wrenches().size(); ++i) {
    const Wrench now = given_.wrenches()[i].now(k);
    sums_[wrench(i)].add_wrench(part, now.point, now.force, now.torque);
  }
  for (std::size_t i = 0; i < input_.springs.size(); ++i) {  // on body b
    const PointSprings::Reading now = given_.springs().reading(i, x, k);
    sums_[spring(i)].add_wrench(part, now.p_B, -now.tension() * now.direction, Vector3::Zero());
  }
}

namespace {

// A linear coupling applies a force at a point, an orientation coupling a torque; a coupling at a
// joint is internal.
void add_coupling_force(double part, const SceneCoupling& spec, const Vector3& force,
                        const Kinematics& k, EnergyMomentum& sum) {
  if (!spec.is_external()) return;
  if (spec.is_linear())
    sum.add_wrench(part, k.position(spec.spring.body, spec.spring.p_L), force, Vector3::Zero());
  else
    sum.add_wrench(part, Vector3::Zero(), Vector3::Zero(), force);
}

}  // namespace

void MomentumBalance::add_couplings(double part, const State<double>& x,
                                    SceneCouplings::Side side) {
  const Kinematics& k = poses_.at(x);
  for (std::size_t c = 0; c < coupling_count_; ++c) {
    const SceneCoupling& spec = couplings_->spec(c);
    if (spec.rate > 0 || spec.printed || spec.third_row() == SceneCoupling::ThirdRow::drive) {
      // held force, or not a spring-damper
      add_coupling_force(part, spec, couplings_->force(c), k, sums_[coupling(c)]);
      continue;
    }
    const CouplingEnds ends = couplings_->ends(c, x, k, side);
    const Vector3 damped = spec.absolute_damper ? Vector3(Vector3::Zero()) : ends.target_velocity;
    add_coupling_force(part, spec,
                       spec.spring.k * ends.offset + spec.spring.b * (damped - ends.velocity), k,
                       sums_[coupling(c)]);
  }
}

// Impulse of the step: force at its start times h, minus m* times the change of link velocity.
void MomentumBalance::add_coupling_impulses(double h, const State<double>& at,
                                            const State<double>& end) {
  const Kinematics& k = poses_.at(at);
  for (std::size_t c = 0; c < coupling_count_; ++c) {
    const SceneCoupling& spec = couplings_->spec(c);
    Vector3 impulse = h * couplings_->force(c);
    if (const double m_star = couplings_->m_star(c); m_star != 0) {
      State<double> mixed = at;  // position at the start, velocity at the end: J dqd
      mixed.qd = end.qd;
      impulse -= m_star * (couplings_->ends(c, mixed, poses_.at(mixed)).velocity -
                           couplings_->ends(c, at, k).velocity);
    }
    add_coupling_force(1, spec, impulse, k, sums_[coupling(c)]);
  }
}

// `qd` at the start; over a step of h velocities change by h qdd.
void MomentumBalance::add_loops(double part, const IntegrationState& at,
                                const std::vector<double>& qd, double h) {
  const ConstraintForceSolver& bilateral = at.dynamics.bilateral();
  const LoopClosures& loops = bilateral.loops();
  if (loop_count_ == 0) return;
  std::vector<double> lambda(loops.rows(), 0);
  bilateral.add_lambda(1, lambda);
  const Eigen::Map<Eigen::VectorXd> all(lambda.data(), static_cast<Eigen::Index>(lambda.size()));
  for (std::size_t r = 0; r < loops.rows(); ++r) {
    double speed = 0;
    for (const std::size_t d : loops.dofs_of(r))
      speed += loops.J()(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(d)) *
               (qd[d] + 0.5 * h * at.w.qdd[d]);
    sums_[loop(loops.loop_of(r))].work += part * lambda[r] * speed;
  }
  for (std::size_t l = 0; l < loop_count_; ++l) {
    const LoopWrench wrench = loops.wrench(l, all);
    sums_[loop(l)].add_wrench(part, loops.point(l), wrench.force, wrench.couple);
  }
}

// k: of the poses of `at`.
void MomentumBalance::add_trees(double part, const IntegrationState& at, const Kinematics& k) {
  const Model<double>& model = input_.model;
  const Workspace<double>& w = at.w;
  for (std::size_t t = 0; t < trees_.size(); ++t)
    for (std::size_t i = 1; i < model.parent.size(); ++i) {
      if (!trees_[t].bodies[i]) continue;
      const Force<double> f = model.I[i] * w.a[i] + crf(w.v[i], model.I[i] * w.v[i]);
      sums_[tree(t)].add_wrench(part, k.X_WL[i].p, k.R_WB[i] * to_eigen(f.f),
                                k.R_WB[i] * to_eigen(f.n));
    }
}

void MomentumBalance::add_impacts(const Simulation& after) {
  if (trees_.empty() || !after.has_constrained_steps() || after.constraints().report().impacts == 0)
    return;
  State<double> then = now_;
  then.qd = after.constraints().velocities_after_impacts();
  for (std::size_t t = 0; t < trees_.size(); ++t) {
    const EnergyMomentum change =
        contents(trees_[t].bodies, then) - contents(trees_[t].bodies, now_);
    sums_[tree(t)].impulse += change.impulse;
    sums_[tree(t)].moment += change.moment;
  }
}

}  // namespace twinarm
