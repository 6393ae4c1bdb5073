// Interface of an engine: it runs scenes, and single algorithms on mechanisms.
//
// One .cpp file per engine, registered automatically. Comments in its first lines state its build
// requirements (CMakeLists.txt):
//   header:     required header, directly or in a folder of the engine's name
//   libraries:  required libraries
//   single:     its single-precision libraries, for bench_contact (default: the same)
//   options:    compiler options, not for single precision
//   standard:   C++ standard, if not 20
#pragma once

#include <ctime>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/scenes/scene.h"

namespace twinarm::bench {

// Integration of a scene: a fixed step, or the tolerance of an adaptive scheme.
struct Scheme {
  std::string name;
  bool adaptive = false;
};

enum class Algorithm {
  forward_dynamics,  // qdd of q, v, tau
  inverse_dynamics,  // tau of q, v, qdd
  mass_matrix,       // of q, by the composite-rigid-body algorithm or the engine's equivalent
  kinematics,        // of q: poses of all bodies
  step,              // one semi-implicit step of 1 ms, without contact
  inverse_mass_matrix,
  derivatives,          // of forward dynamics by q, v and tau
  constrained_dynamics  // qdd of q, v, tau, with the origin of the last body held in place
};
inline constexpr double step_length = 1e-3;  // [s]

// Report of the constraint solver on one step.
struct SolverReading {
  double residual = 0;  // of the laws of contact [m/s]
  bool converged = true;
  double detection = 0, solver = 0, whole = 0;  // time spent [s]
};

class Engine {
 public:
  virtual ~Engine() = default;
  virtual std::string name() const = 0;

  // ---- scenes ----
  virtual std::string refusal(const Scene&) const { return {}; }  // why the scene is not supported
  // Integrations of a scene that is supported, the engine's default first.
  virtual std::vector<Scheme> schemes(const Scene&) const { return {}; }
  // Of a scene with contacts that bench_contact times in this engine; empty: it does not.
  virtual std::vector<Scheme> contact_schemes(const Scene&) const { return {}; }
  virtual void load(const Scene&, const Scheme&, double /*step_or_tolerance*/) {}
  virtual void step() {}                 // timed; adaptive schemes choose its size
  virtual void advance(double /*t*/) {}  // timed; to a multiple of the step
  virtual void read(std::vector<double>& /*q*/, std::vector<double>& /*v*/) {}  // as in Scene
  // A step with internal timers, separate from the timed step; for engines that allow it.
  virtual std::optional<SolverReading> watched_step() {
    step();
    return std::nullopt;
  }

  // ---- algorithms, for revolute trees, optionally with a free base ----
  // Timed: the algorithm and setting q, v, tau in the engine's own coordinates, a cost of any user.
  // Not timed: the conversion to those coordinates.
  virtual bool has(Algorithm) const { return false; }
  // Tolerance of its qdd against twinarm in double, relative to the largest entry.
  virtual double tolerance(const Scene&) const { return 1e-9; }
  virtual double constrained_tolerance() const { return 1e-9; }
  virtual void load_mechanism(const Scene& /*mechanism*/) {}     // once per engine object
  virtual void set_situations(const std::vector<Situation>&) {}  // converts them; not timed
  virtual void run(Algorithm) {}                                 // timed, for each situation
  // Not timed: forward, inverse and constrained dynamics of situation k.
  virtual std::vector<double> qdd(std::size_t /*k*/) { return {}; }
  virtual std::vector<double> tau(std::size_t /*k*/) { return {}; }
  virtual std::vector<double> constrained_qdd(std::size_t /*k*/) { return {}; }
};

// Fixed steps, and coordinates joint by joint: the common case of a peer.
class FixedStepEngine : public Engine {
 public:
  void advance(double t) override {
    while (t - static_cast<double>(steps_) * h_ > 0.5 * h_) step(), ++steps_;
  }
  void read(std::vector<double>& q, std::vector<double>& v) override {
    q.resize(scene_.q.size()), v.resize(scene_.v.size());
    for_each_joint(scene_, q.data(), v.data(), [&](auto... joint) { read_joint(joint...); });
  }

 protected:
  void begin(const Scene& scene, double h) { scene_ = scene, h_ = h, steps_ = 0; }
  void set_joints() {
    for_each_joint(scene_, scene_.q.data(), scene_.v.data(),
                   [&](auto... joint) { set_joint(joint...); });
  }
  // q and v of the joint of a body, as in Scene.
  virtual void set_joint(std::size_t /*body*/, const double* /*q*/, const double* /*v*/) {}
  virtual void read_joint(std::size_t /*body*/, double* /*q*/, double* /*v*/) {}

  Scene scene_;  // or mechanism
  double h_ = 0;
  long steps_ = 0;
};

// Also with algorithms, on situations in coordinates of the engine.
template <class Converted>
class PeerEngine : public FixedStepEngine {
 public:
  bool has(Algorithm algorithm) const override { return algorithm <= Algorithm::step; }
  void set_situations(const std::vector<Situation>& situations) override {
    situations_ = situations, converted_.clear();
    for (const Situation& s : situations) converted_.push_back(convert(s));
  }
  void run(Algorithm algorithm) override {
    for (const Converted& s : converted_) run_one(algorithm, s);
  }

 protected:
  virtual Converted convert(const Situation&) const = 0;
  virtual void run_one(Algorithm, const Converted&) = 0;

  std::vector<Situation> situations_;
  std::vector<Converted> converted_;
};

using Engines = std::vector<std::unique_ptr<Engine>>;

struct EngineKind {
  std::string name;
  int order;          // of display; twinarm, the reference, is first
  Engines (*make)();  // its variants; the first one also runs scenes
};
template <class E>
Engines one_engine() {
  Engines engines;
  engines.push_back(std::make_unique<E>());
  return engines;
}

const std::vector<EngineKind>& engine_kinds();  // made by twinarm_registry()
std::vector<EngineKind> kinds_in_order();       // in this build
Engines engines_of_build(const std::function<bool(const Engine&)>& is_wanted);  // all variants
std::vector<std::string> missing_engines();  // libraries not found
std::vector<std::string> names_of(const Engines& engines);

inline double thread_seconds() {  // CPU time of this thread [s]
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace twinarm::bench
