// twinarm: scenes and algorithms through its public interface. S is double, float or Batch<N>; a
// batch takes N situations per call.
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "benchmarks/engines/twinarm_run.h"
#include "solver/dynamics/dynamics.h"
#include "solver/model/convert_model.h"

namespace twinarm::bench {
namespace {

// The number of situations in an S, and number k of them.
template <class S>
constexpr std::size_t lanes = 1;
template <int N>
constexpr std::size_t lanes<Batch<N>> = N;
template <class S>
void set_lane(S& all, std::size_t k, double value) {
  if constexpr (lanes < S >> 1)
    all.set(static_cast<int>(k), value);
  else
    all = static_cast<S>(value);
}
template <class S>
double lane(const S& all, std::size_t k) {
  if constexpr (lanes < S >> 1)
    return all[static_cast<int>(k)];
  else
    return static_cast<double>(all);
}

template <class S>
class TwinarmPasses : public Engine {
 public:
  TwinarmPasses(std::string name, Isa isa) : name_(std::move(name)), passes_(passes<S>(isa)) {}

  std::string name() const override { return name_; }
  bool has(Algorithm) const override { return true; }
  // Single precision: the measured error of the articulated-body algorithm is a tenth of this, from
  // 1 to 512 joints.
  double tolerance(const Scene& mechanism) const override {
    const auto n = static_cast<double>(mechanism.bodies.size() + (mechanism.floats() ? 5 : 0));
    return std::is_same_v<S, float> ? 1e-6 * (10 + n) : Engine::tolerance(mechanism);
  }
  void load_mechanism(const Scene& mechanism) override {
    model_ = convert<S>(model_of(mechanism));
    w_.emplace(model_);
    M_.resize(model_.nv * model_.nv);
  }
  void set_situations(const std::vector<Situation>& situations) override {
    const std::size_t count = (situations.size() + lanes<S> - 1) / lanes<S>;
    calls_.assign(count, Call{State<S>(model_), Forces<S>(model_), std::vector<S>(model_.nv)});
    for (std::size_t k = 0; k < count * lanes<S>; ++k) {
      const Situation& s = situations[k % situations.size()];
      Call& call = calls_[k / lanes<S>];
      for (std::size_t i = 0; i < s.q.size(); ++i) set_lane(call.x.q[i], k % lanes<S>, s.q[i]);
      for (std::size_t i = 0; i < s.v.size(); ++i) {
        set_lane(call.x.qd[i], k % lanes<S>, s.v[i]);
        set_lane(call.forces.tau[i], k % lanes<S>, s.tau[i]);
        set_lane(call.qdd[i], k % lanes<S>, s.qdd[i]);
      }
    }
  }
  void run(Algorithm algorithm) override {
    for (const Call& call : calls_) run(algorithm, call);
  }
  std::vector<double> qdd(std::size_t k) override {
    run(Algorithm::forward_dynamics, calls_[k / lanes<S>]);
    return of_lane(w_->qdd, k);
  }
  std::vector<double> tau(std::size_t k) override {
    run(Algorithm::inverse_dynamics, calls_[k / lanes<S>]);
    return of_lane(w_->tau, k);
  }

 protected:
  struct Call {  // input of one call of a pass
    State<S> x;
    Forces<S> forces;
    std::vector<S> qdd;
  };

  static std::vector<double> of_lane(const std::vector<S>& by_velocity, std::size_t k) {
    std::vector<double> out;
    for (const S& all : by_velocity) out.push_back(lane(all, k % lanes<S>));
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
    }
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
  std::vector<Call> calls_;
  State<S> next_;
  std::vector<S> shift_;
};

// The variant that runs scenes.
class Twinarm final : public TwinarmPasses<double> {
 public:
  Twinarm() : TwinarmPasses("twinarm double", best_isa()) {}
  std::vector<Scheme> schemes(const Scene& scene) const override { return twinarm_schemes(scene); }
  bool is_timed_with_contacts() const override { return true; }
  void load(const Scene& scene, const Scheme& scheme, double h) override {
    run_.reset();
    run_.emplace(scene, scheme, h);
    scheme_ = scheme, h_ = h, steps_ = 0, until_ = 0;
  }
  void step() override {
    const double h = scheme_.adaptive ? std::min(0.1, until_ - t()) : h_;
    const StepReport report = run_->simulation.step(h, scheme_.adaptive);
    if (!report.ok()) throw std::runtime_error("the run stopped by itself");
    ++steps_;
  }
  void advance(double t_end) override {
    until_ = t_end;
    if (scheme_.adaptive)
      while (until_ - t() > 1e-10) step();
    else
      while (t_end - static_cast<double>(steps_) * h_ > 0.5 * h_) step();
  }
  void read(std::vector<double>& q, std::vector<double>& v) override {
    q = run_->simulation.state().q, v = run_->simulation.state().qd;
  }
  std::optional<SolverReading> watched_step() override {
    WatchedContacts& watch = *run_->contacts;
    watch.watched = true;
    watch.detection = watch.solver = 0;
    const double start = thread_seconds();
    step();
    const double whole = thread_seconds() - start;
    watch.watched = false;
    const ImpulseReport& report = run_->simulation.constraints().report().step;
    return SolverReading{report.residual, report.converged, watch.detection, watch.solver, whole};
  }

 private:
  double t() const { return run_->simulation.state().t; }
  std::optional<TwinarmRun> run_;
  Scheme scheme_;
  double h_ = 0, until_ = 0;
  long steps_ = 0;
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
  engines.push_back(std::make_unique<TwinarmPasses<float>>("twinarm float", best));
  engines.push_back(std::make_unique<TwinarmPasses<Batch<4>>>("twinarm batch4", best));
  engines.push_back(std::make_unique<TwinarmPasses<Batch<8>>>("twinarm batch8", best));
  return engines;
}

}  // namespace

EngineKind twinarm_engine() {
  return {"twinarm", 0, variants};
}

}  // namespace twinarm::bench
