// twinarm itself, through the passes as any program calls them. S is double, float or Batch<N>; a
// batch takes N situations in one call.
#include <optional>
#include <type_traits>

#include "benchmarks/speed/eigen.h"
#include "benchmarks/speed/engine.h"
#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/model_builder.h"
#include "solver/model/convert_model.h"

namespace twinarm::speed {
namespace {

Model<double> build(const Mechanism& mechanism) {
  ModelBuilder builder;
  builder.set_gravity({0, 0, -standard_gravity});
  for (std::size_t i = 0; i < mechanism.links.size(); ++i) {
    const Link& link = mechanism.links[i];
    const std::string number = std::to_string(i);
    const bool free = i < mechanism.first_joint();
    const Pose X = free ? Pose{} : Pose{matrix3(link.rotation), vector3(link.position)};
    builder.add_body("link" + number, link.parent + 1, "joint" + number,
                     free ? JointType::free : JointType::revolute, X,
                     Vector3::Unit(static_cast<Eigen::Index>(link.axis)),
                     {link.mass, vector3(link.com), matrix3(link.inertia)});
  }
  return builder.build();
}

// How many situations an S holds, and one of them.
template <class S>
constexpr std::size_t lanes = 1;
template <class S>
void set_lane(S& all, std::size_t, double value) {
  all = static_cast<S>(value);
}
template <class S>
double lane(const S& all, std::size_t) {
  return static_cast<double>(all);
}
template <int N>
constexpr std::size_t lanes<Batch<N>> = N;
template <int N>
void set_lane(Batch<N>& all, std::size_t k, double value) {
  all.set(static_cast<int>(k), value);
}
template <int N>
double lane(const Batch<N>& all, std::size_t k) {
  return all[static_cast<int>(k)];
}

template <class S>
class Twinarm : public Engine {
 public:
  Twinarm(std::string name, Isa isa) : name_(std::move(name)), passes_(passes<S>(isa)) {}

  std::string name() const override { return name_; }
  bool has(Algorithm) const override { return true; }
  // In single precision the error of the articulated-body algorithm was seen to be a tenth of this,
  // from 1 joint to 512.
  double tolerance(const Mechanism& mechanism) const override {
    const auto n = static_cast<double>(mechanism.nv());
    return std::is_same_v<S, float> ? 1e-6 * (10 + n) : Engine::tolerance(mechanism);
  }

  void load(const Mechanism& mechanism) override {
    mechanism_ = mechanism;
    model_ = convert<S>(build(mechanism));
    w_.emplace(model_);
  }

  void set_situations(const std::vector<Situation>& situations) override {
    const std::size_t count = (situations.size() + lanes<S> - 1) / lanes<S>;
    calls_.assign(count, Call{State<S>(model_), Forces<S>(model_), std::vector<S>(model_.nv)});
    for (std::size_t k = 0; k < count * lanes<S>; ++k) {
      const Situation& s = situations[k % situations.size()];
      Call& call = calls_[k / lanes<S>];
      for (std::size_t i = 0; i < s.q.size(); ++i) set_lane(call.x.q[i], k % lanes<S>, s.q[i]);
      for (std::size_t i = 0; i < s.v.size(); ++i) {
        set_lane(call.x.qd[ours(i)], k % lanes<S>, s.v[i]);
        set_lane(call.forces.tau[ours(i)], k % lanes<S>, s.tau[i]);
        set_lane(call.qdd[ours(i)], k % lanes<S>, s.qdd[i]);
      }
    }
  }

  void run(Algorithm algorithm) override {
    for (const Call& call : calls_) run(algorithm, call);
  }
  std::vector<double> qdd(std::size_t k) override {
    run(Algorithm::forward_dynamics, calls_[k / lanes<S>]);
    return canonical(w_->qdd, k);
  }
  std::vector<double> tau(std::size_t k) override {
    run(Algorithm::inverse_dynamics, calls_[k / lanes<S>]);
    return joints_of(mechanism_, canonical(w_->tau, k));
  }

 protected:
  struct Call {  // what one call of a pass is given
    State<S> x;
    Forces<S> forces;
    std::vector<S> qdd;
  };

  // Ours are the canonical velocities, but with the angular part of a free joint first.
  std::size_t ours(std::size_t i) const { return mechanism_.floating && i < 6 ? (i + 3) % 6 : i; }
  std::vector<double> canonical(const std::vector<S>& by_velocity, std::size_t k) const {
    std::vector<double> out;
    for (std::size_t i = 0; i < by_velocity.size(); ++i)
      out.push_back(lane(by_velocity[ours(i)], k % lanes<S>));
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
        passes_.crba(model_, call.x, *w_);
        return;
      case Algorithm::kinematics:  // with the velocities: there is no less
        passes_.kinematics(model_, call.x, *w_);
        return;
      case Algorithm::step:
        step(call);
    }
  }
  void step(const Call& call) {
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
  Mechanism mechanism_;
  Model<S> model_;
  std::optional<Workspace<S>> w_;
  std::vector<Call> calls_;
  State<S> next_;
  std::vector<S> shift_;
};

// The same with everything kept that a body hands on: what looking inside costs.
class Traced : public Twinarm<double> {
 public:
  Traced() : Twinarm("twinarm double traced", Isa::generic) {}
  bool has(Algorithm algorithm) const override { return algorithm == Algorithm::forward_dynamics; }
  void load(const Mechanism& mechanism) override {
    Twinarm::load(mechanism);
    trace_.emplace(model_.parent.size());
  }
  using Twinarm::run;

 private:
  void run(Algorithm, const Call& call) override { aba(model_, call.x, call.forces, *w_, *trace_); }
  std::optional<FullTrace<double>> trace_;
};

}  // namespace

void add_twinarm(Engines& engines) {
  const Isa best = best_isa();
  engines.push_back(std::make_unique<Twinarm<double>>("twinarm double", best));
  for (const Isa isa : {Isa::v3, Isa::generic})
    if (isa < best)
      engines.push_back(
          std::make_unique<Twinarm<double>>(std::string("twinarm double ") + name_of(isa), isa));
  engines.push_back(std::make_unique<Traced>());
  engines.push_back(std::make_unique<Twinarm<float>>("twinarm float", best));
  engines.push_back(std::make_unique<Twinarm<Batch<4>>>("twinarm batch4", best));
  engines.push_back(std::make_unique<Twinarm<Batch<8>>>("twinarm batch8", best));
}

}  // namespace twinarm::speed
