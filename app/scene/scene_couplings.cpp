#include "app/scene/scene_couplings.h"

#include <cmath>
#include <limits>
#include <utility>

#include "collision/import/number_text.h"
#include "coupling/automatic_motion.h"
#include "coupling/linear.h"
#include "coupling/paced_hand.h"
#include "coupling/recorded_trace.h"
#include "coupling/torsional.h"

namespace twinarm {
namespace {

// Of a target that stands still: no joint is turned by it.
class RestingHand final : public HandSource {
 public:
  HandSample sample(double, double) const override { return {}; }
  double duration() const override { return std::numeric_limits<double>::infinity(); }
  std::string description() const override { return "at rest"; }
};

class RewindableCoupling : public ForceSource, public Rewindable {
 public:
  virtual const Coupling& coupling() const = 0;
};

// A coupling whose held force and readings can be put aside. The kinematic robot is a function of
// time alone, and needs none of that.
template <class C>
class Kept final : public RewindableCoupling {
 public:
  explicit Kept(C coupling) : coupling_(std::move(coupling)) {}
  void begin_step(const Kinematics& k, double t, double h) noexcept override {
    coupling_->begin_step(k, t, h);
  }
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    coupling_->add_forces(x, k, forces);
  }
  bool needs_semi_implicit() const override { return coupling_->needs_semi_implicit(); }
  void keep() override { kept_.emplace(*coupling_); }
  void go_back() noexcept override { coupling_.emplace(*kept_); }
  void visit_memory(Memory& memory) override { coupling_->visit_memory(memory); }
  const Coupling& coupling() const override { return *coupling_; }

 private:
  std::optional<C> coupling_, kept_;
};

// Steps between two evaluations of a force that is held; 0: none is held.
int hold_steps(const SceneModel& scene, const SceneCoupling& coupling, double h,
               FaultList& faults) {
  if (coupling.rate == 0) return 0;
  const double steps = 1 / (coupling.rate * h), whole = std::round(steps);
  if (whole >= 1 && std::abs(steps - whole) <= 1e-6 * whole) return static_cast<int>(whole);
  faults.add({scene.description.file.string(), coupling.line, "coupling '" + coupling.name + "'",
              "between two evaluations at " + short_number_text(coupling.rate) + " Hz lie " +
                  short_number_text(steps) + " steps of " + short_number_text(h) + " s",
              "choose rate and step so that it is a whole number"});
  return 1;
}

std::unique_ptr<HandSource> hand_of_target(const SceneModel& scene, const SceneCoupling& coupling,
                                           FaultList& faults) {
  switch (coupling.target) {
    case CouplingTarget::Kind::paper:
      return std::make_unique<AutomaticMotion>(HandMapping{});
    case CouplingTarget::Kind::trace:
      try {
        return std::make_unique<RecordedTrace>(coupling.trace);
      } catch (const InputError& error) {
        faults.add(error.faults());
      }
      break;
    case CouplingTarget::Kind::device:
      faults.add({scene.description.file.string(), coupling.line,
                  "coupling '" + coupling.name + "', target", "no hand device is connected here",
                  "give a state, \"paper\" or a trace file"});
      break;
    case CouplingTarget::Kind::start:
    case CouplingTarget::Kind::state:
      break;
  }
  return std::make_unique<RestingHand>();
}

std::unique_ptr<HandSource> make_hand(const SceneModel& scene, const SceneCoupling& coupling,
                                      FaultList& faults) {
  auto hand = hand_of_target(scene, coupling, faults);
  if (coupling.delay == 0 && coupling.speed == 1) return hand;
  return std::make_unique<PacedHand>(std::move(hand), coupling.delay, coupling.speed);
}

}  // namespace

struct SceneCouplings::Tie {
  Tie(const SceneModel& scene, const SceneCoupling& spec, double h, FaultList& faults)
      : hand(make_hand(scene, spec, faults)),
        kvr(scene.model, *hand, {}, {spec.turned, "", 0, 0},
            spec.absolute_damper ? KvrRates::none : KvrRates::from_hand),
        shown(scene.model, *hand, {}, {spec.turned, "", 0, 0}) {
    kvr.stand_at(spec.rest);
    shown.stand_at(spec.rest);
    const int hold = hold_steps(scene, spec, h, faults);
    if (spec.type == CouplingDescription::Type::linear)
      source = std::make_unique<Kept<LinearCoupling>>(
          LinearCoupling(spec.name, scene.model, kvr, {spec.spring}, spec.treatment, hold));
    else
      source = std::make_unique<Kept<TorsionalCoupling>>(TorsionalCoupling(
          spec.name, scene.model, kvr, {spec.spring}, spec.measure, spec.treatment, hold));
  }

  std::unique_ptr<HandSource> hand;
  KinematicRobot kvr, shown;
  std::unique_ptr<RewindableCoupling> source;
};

SceneCouplings::SceneCouplings(const SceneModel& scene, double h) : scene_(scene) {
  FaultList faults;
  for (const SceneCoupling& coupling : scene.couplings)
    ties_.push_back(std::make_unique<Tie>(scene, coupling, h, faults));
  faults.check();
}

SceneCouplings::~SceneCouplings() = default;

ForceSource& SceneCouplings::source(std::size_t c) {
  return *ties_[c]->source;
}

const Coupling& SceneCouplings::coupling(std::size_t c) const {
  return ties_[c]->source->coupling();
}

const KvrSample& SceneCouplings::target(std::size_t c, double t, Side side) {
  KinematicRobot& shown = ties_[c]->shown;
  shown.begin_step(t, side == Side::after ? 1e-6 : -1e-6);  // within the motion that is meant
  return shown.start();
}

CouplingEnds SceneCouplings::ends(std::size_t c, const State<double>& x, const Kinematics& k,
                                  Side side) {
  const SceneCoupling& spec = scene_.couplings[c];
  const KvrSample& kvr = target(c, x.t, side);
  const auto i = static_cast<std::size_t>(spec.spring.body);
  CouplingEnds ends;
  if (spec.type == CouplingDescription::Type::linear) {
    const Vector3 p_D = k.position(spec.spring.body, spec.spring.p_L);
    const Vector3 p_K = kvr.k.position(spec.spring.body, spec.spring.p_L);
    ends = {p_K - p_D, k.velocity(spec.spring.body, p_D), kvr.k.velocity(spec.spring.body, p_K)};
  } else if (spec.measure == Measure::world) {
    ends = {rotation_vector(kvr.k.X_WL[i].R * k.X_WL[i].R.transpose()), k.w_WL[i], kvr.k.w_WL[i]};
  } else {
    const std::size_t iq = scene_.model.iq[i], iv = scene_.model.iv[i];
    ends.offset.x() = kvr.x.q[iq] - x.q[iq];
    ends.velocity.x() = x.qd[iv];
    ends.target_velocity.x() = kvr.x.qd[iv];
  }
  return ends;
}

Vector3 SceneCouplings::pull(std::size_t c) const {
  const SceneCoupling& spec = scene_.couplings[c];
  const SpringReading& reading = coupling(c).readings()[0];
  const bool at_joint =
      spec.type == CouplingDescription::Type::torsional && spec.measure == Measure::joint;
  return at_joint ? Vector3(reading.size, 0, 0) : reading.pull;
}

double SceneCouplings::m_star(std::size_t c, double h) const {
  const SceneCoupling& spec = scene_.couplings[c];
  const double by_damper = h * spec.spring.b, by_spring = h * h * spec.spring.k;
  switch (spec.treatment) {
    case Treatment::explicit_:
      return 0;
    case Treatment::semi_implicit:
      return by_damper;
    case Treatment::implicit:
      break;
  }
  return by_damper + by_spring;
}

}  // namespace twinarm
