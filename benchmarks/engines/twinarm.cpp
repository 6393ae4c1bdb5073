// twinarm: scenes and algorithms through its public interface. S is double or Batch<N>; a batch
// takes N situations per call.
#include <cmath>
#include <stdexcept>

#include "benchmarks/engines/twinarm_sources.h"
#include "solver/dynamics/derivatives.h"
#include "solver/loops/constrained_dynamics.h"
#include "solver/model/convert_model.h"

namespace twinarm::bench {
namespace {

template <class S>
class TwinarmPasses : public FixedStepEngine {
 public:
  TwinarmPasses(std::string name, Isa isa) : name_(std::move(name)), passes_(passes<S>(isa)) {}

  std::string name() const override { return name_; }
  bool has(Algorithm algorithm) const override {
    return algorithm <= Algorithm::step ||
           (std::is_same_v<S, double> && algorithm <= Algorithm::derivatives);
  }
  void load_mechanism(const Scene& mechanism) override {
    model_ = convert<S>(model_of(mechanism));
    w_.emplace(model_);
    M_.resize(model_.nv * model_.nv);
    if constexpr (std::is_same_v<S, double>) matrices_.emplace(model_), rates_.emplace(model_);
  }
  void set_situations(const std::vector<Situation>& situations) override {
    const std::size_t count = (situations.size() + lanes - 1) / lanes;
    calls_.assign(count, Call{State<S>(model_), Forces<S>(model_), std::vector<S>(model_.nv)});
    for (std::size_t k = 0; k < count * lanes; ++k) {
      const Situation& s = situations[k % situations.size()];
      Call& call = calls_[k / lanes];
      for (std::size_t i = 0; i < s.q.size(); ++i) set_lane(call.x.q[i], k % lanes, s.q[i]);
      for (std::size_t i = 0; i < s.v.size(); ++i) {
        set_lane(call.x.qd[i], k % lanes, s.v[i]);
        set_lane(call.forces.tau[i], k % lanes, s.tau[i]);
        set_lane(call.qdd[i], k % lanes, s.qdd[i]);
      }
    }
  }
  void run(Algorithm algorithm) override {
    for (const Call& call : calls_) run(algorithm, call);
  }
  std::vector<double> qdd(std::size_t k) override {
    run(Algorithm::forward_dynamics, calls_[k / lanes]);
    return of_lane(w_->qdd, k);
  }
  std::vector<double> tau(std::size_t k) override {
    run(Algorithm::inverse_dynamics, calls_[k / lanes]);
    return of_lane(w_->tau, k);
  }

 protected:
  static constexpr std::size_t lanes = sizeof(S) / sizeof(double);  // situations in a call

  struct Call {  // input of one call of a pass
    State<S> x;
    Forces<S> forces;
    std::vector<S> qdd;
  };

  static std::vector<double> of_lane(const std::vector<S>& by_velocity, std::size_t k) {
    std::vector<double> out;
    for (const S& all : by_velocity) out.push_back(lane_of(all, k % lanes));
    return out;
  }

  virtual void run(Algorithm algorithm, const Call& call) {
    switch (algorithm) {
      case Algorithm::forward_dynamics:
        passes_.aba(model_, call.x, call.forces, *w_);
        return;
      case Algorithm::inverse_dynamics:
        passes_.rnea(model_, call.x, call.qdd, call.forces.f_ext, *w_);
        return;
      case Algorithm::mass_matrix:
        passes_.crba(model_, call.x, *w_, M_);
        return;
      case Algorithm::kinematics:  // includes velocities
        passes_.kinematics(model_, call.x, *w_);
        return;
      case Algorithm::step:
        step_from(call);
        return;
      case Algorithm::inverse_mass_matrix:
      case Algorithm::derivatives:
        if constexpr (std::is_same_v<S, double>) run_matrix_pass(algorithm, call);
        return;
      case Algorithm::constrained_dynamics:  // of Twinarm
        return;
    }
  }
  void run_matrix_pass(Algorithm algorithm, const Call& call) {
    if (algorithm == Algorithm::inverse_mass_matrix)
      return passes_.minv_matrix(model_, call.x, *w_, *matrices_, M_);
    passes_.aba(model_, call.x, call.forces, *w_);
    passes_.aba_derivatives(model_, call.x, call.forces, *w_, *matrices_, *rates_);
  }
  void step_from(const Call& call) {
    passes_.aba(model_, call.x, call.forces, *w_);
    next_ = call.x;
    shift_.resize(model_.nv);
    for (std::size_t i = 0; i < model_.nv; ++i) {
      next_.qd[i] = next_.qd[i] + S(step_length) * w_->qdd[i];
      shift_[i] = S(step_length) * next_.qd[i];
    }
    for (std::size_t i = 1; i < model_.parent.size(); ++i)
      visit_joint(model_, i, [&](auto joint) {
        joint.integrate(call.x.q.data() + model_.iq[i], shift_.data() + model_.iv[i],
                        next_.q.data() + model_.iq[i]);
      });
  }

  std::string name_;
  const Passes<S>& passes_;
  Model<S> model_;
  std::optional<Workspace<S>> w_;
  std::vector<S> M_;
  std::optional<MatrixWorkspace<S>> matrices_;  // of double only
  std::optional<AbaDerivatives<S>> rates_;
  std::vector<Call> calls_;
  State<S> next_;
  std::vector<S> shift_;
};

// The variant that runs scenes, with every integrator; contacts by the rigid response, with fixed
// steps and with located impacts.
class Twinarm final : public TwinarmPasses<double> {
 public:
  Twinarm() : TwinarmPasses("twinarm double", best_isa()) {}
  std::vector<Scheme> schemes(const Scene& scene) const override {
    constexpr std::size_t kMaxLocated = 50;  // bodies; larger piles have too many impacts to locate
    std::vector<Scheme> all{{"semi-implicit"}};
    if (scene.has_contacts()) {
      if (scene.bodies.size() <= kMaxLocated) all.push_back({kLocated});
      return all;
    }
    for (const IntegratorFacts& facts : all_integrators)
      if (facts.integrator != Integrator::semi_implicit)
        all.push_back({facts.name, facts.integrator == Integrator::dopri5});
    return all;
  }
  std::vector<Scheme> contact_schemes(const Scene&) const override {
    return {{"semi-implicit"}, {kCoarse}, {kRealTime}};
  }
  bool has(Algorithm) const override { return true; }
  void load_mechanism(const Scene& mechanism) override {
    TwinarmPasses::load_mechanism(mechanism);
    LoopClosure pin;
    pin.body_b = static_cast<int>(mechanism.bodies.size());
    constrained_.emplace(model_);
    constrained_->bilateral().set_loops(LoopClosures(model_, {pin}));
    frames_.emplace(model_);
    forces_.emplace(model_);
  }
  std::vector<double> constrained_qdd(std::size_t k) override {
    run(Algorithm::constrained_dynamics, calls_[k]);
    return w_->qdd;
  }
  using TwinarmPasses::run;
  void run(Algorithm algorithm, const Call& call) override {
    if (algorithm != Algorithm::constrained_dynamics) return TwinarmPasses::run(algorithm, call);
    forces_->tau = call.forces.tau;
    forward_kinematics(model_, call.x, *frames_);
    constrained_->bilateral().loops().evaluate(call.x, *frames_);
    (*constrained_)(call.x, *forces_, *w_);
  }
  void load(const Scene& scene, const Scheme& scheme, double h) override {
    simulation_.reset();
    begin(scene, h);
    scheme_ = scheme, until_ = 0;
    model_ = model_of(scene);
    State<double> start(model_);
    start.q = scene.q, start.qd = scene.v;
    simulation_.emplace(model_, start);
    if (scene.has_contacts()) {
      contacts_.emplace(model_, ContactResponse::rigid);
      add_shapes();
      simulation_->add(*contacts_);
      if (scheme.name == kLocated) simulation_->locate_events();
      if (scheme.name == kCoarse)
        simulation_->set_impulse_effort(1e-4, 2e8 * static_cast<double>(scene.bodies.size()));
      if (scheme.name == kRealTime) simulation_->set_impulse_effort(1e-4, 1e9);  // as the lab
    } else {
      simulation_->set_integrator(find_integrator(scheme.name).value(), h);
    }
    if (has_pushes(scene_)) simulation_->add(pushes_);
  }
  void step() override {
    const double h = scheme_.adaptive ? std::min(0.1, until_ - t()) : h_;
    const StepReport report = simulation_->step(h, scheme_.adaptive);
    // Steps that end by the budget: counted by the watched run.
    const bool counted =
        scheme_.name == kCoarse || scheme_.name == kRealTime || (contacts_ && contacts_->watched);
    if (!report.ok() && !(counted && report.finite))
      throw std::runtime_error("the run stopped by itself");
  }
  void advance(double t_end) override {
    if (!scheme_.adaptive) return FixedStepEngine::advance(t_end);
    until_ = t_end;
    while (until_ - t() > 1e-10) step();
  }
  void read(std::vector<double>& q, std::vector<double>& v) override {
    q = simulation_->state().q, v = simulation_->state().qd;
  }
  std::optional<SolverReading> watched_step() override {
    WatchedContacts& watch = *contacts_;
    watch.watched = true;
    watch.detection = watch.solver = 0;
    const double start = thread_seconds();
    step();
    const double whole = thread_seconds() - start;
    watch.watched = false;
    const ImpulseReport& report = simulation_->constraints().report().step;
    return SolverReading{report.residual, report.converged, watch.detection, watch.solver, whole};
  }

 private:
  // Friction of a pair is the geometric mean, restitution the product.
  void add_shapes() {
    ContactSurface body, fixed;
    body.friction = fixed.friction = scene_.friction;
    if (scene_.floor && scene_.floor_friction != scene_.friction)
      fixed.friction = scene_.floor_friction * scene_.floor_friction / scene_.friction;
    body.restitution = fixed.restitution = std::sqrt(scene_.restitution);
    if (scene_.floor) contacts_->bodies().add({"floor", 0, {}, HalfSpace{}, fixed});
    for (const Scene::FixedBox& box : scene_.fixed_boxes)
      contacts_->bodies().add(
          {"fixed", 0, {Matrix3::Identity(), box.centre}, Box{2 * box.half}, fixed});
    int number = 0;
    for (const Body& b : scene_.bodies) {
      ++number;
      const Pose X_LG{Matrix3::Identity(), b.form_at};
      if (b.form == Form::sphere)
        contacts_->bodies().add({"body", number, X_LG, Sphere{b.half[0]}, body});
      if (b.form == Form::box)
        contacts_->bodies().add({"body", number, X_LG, Box{2 * b.half}, body});
    }
  }
  double t() const { return simulation_->state().t; }

  static constexpr const char* kCoarse = "accuracy 1e-4";
  static constexpr const char* kRealTime = "budget 1e9/s";
  static constexpr const char* kLocated = "located";  // the scheme that locates contact events
  std::optional<ForwardDynamics> constrained_;
  std::optional<Kinematics> frames_;
  std::optional<Forces<double>> forces_;
  ForceLaw pushes_ = pushes_of(scene_);
  std::optional<WatchedContacts> contacts_;
  std::optional<Simulation> simulation_;
  Scheme scheme_;
  double until_ = 0;
};

// Forward dynamics with a full trace: the cost of tracing.
class Traced final : public TwinarmPasses<double> {
 public:
  Traced() : TwinarmPasses("twinarm double traced", Isa::generic) {}
  bool has(Algorithm algorithm) const override { return algorithm == Algorithm::forward_dynamics; }
  void load_mechanism(const Scene& mechanism) override {
    TwinarmPasses::load_mechanism(mechanism);
    trace_.emplace(model_.parent.size());
  }
  using TwinarmPasses::run;

 private:
  void run(Algorithm, const Call& call) override { aba(model_, call.x, call.forces, *w_, *trace_); }
  std::optional<FullTrace<double>> trace_;
};

Engines variants() {
  const Isa best = best_isa();
  Engines engines = one_engine<Twinarm>();
  for (const Isa isa : {Isa::v3, Isa::generic})
    if (isa < best)
      engines.push_back(std::make_unique<TwinarmPasses<double>>(
          std::string("twinarm double ") + name_of(isa), isa));
  engines.push_back(std::make_unique<Traced>());
  engines.push_back(std::make_unique<TwinarmPasses<Batch<4>>>("twinarm batch4", best));
  engines.push_back(std::make_unique<TwinarmPasses<Batch<8>>>("twinarm batch8", best));
  return engines;
}

}  // namespace

EngineKind twinarm_engine() {
  return {"twinarm", 0, variants};
}

}  // namespace twinarm::bench
