// What an engine is asked for: to run scenes, and to run single algorithms on mechanisms.
//
// One .cpp file for each, registered by being there. Its first lines say in comments what it is
// built with (CMakeLists.txt):
//   header:     a header that must be found, itself or in a folder of the engine's name
//   libraries:  that must be found
//   single:     its libraries in single precision, which bench_contact takes (left out: the same)
//   options:    of the compiler, not in single precision
//   standard:   of C++, where it is not 20
#pragma once

#include <ctime>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/scenes/scene.h"

namespace twinarm::bench {

// By what a scene is run: a step of fixed size, or a tolerance of an adaptive scheme.
struct Scheme {
  std::string name;
  bool adaptive = false;
};

enum class Algorithm {
  forward_dynamics,  // qdd of q, v, tau
  inverse_dynamics,  // tau of q, v, qdd
  mass_matrix,       // of q, by the composite-rigid-body algorithm or what the engine has for it
  kinematics,        // of q: where every body is
  step               // one semi-implicit step of 1 ms, without contact
};
inline constexpr double step_length = 1e-3;  // [s]

// What a constraint solver reports of one step.
struct SolverReading {
  double residual = 0;  // of the laws of contact [m/s]
  bool converged = true;
  double detection = 0, solver = 0, whole = 0;  // where the time of the step went [s]
};

class Engine {
 public:
  virtual ~Engine() = default;
  virtual std::string name() const = 0;

  // ---- scenes ----
  // Those that can run the scene, the one that the engine comes with first; none: see refusal().
  virtual std::vector<Scheme> schemes(const Scene&) const { return {}; }
  virtual std::string refusal(const Scene&) const { return {}; }  // why it cannot express it
  virtual bool is_timed_with_contacts() const { return false; }   // in bench_contact
  virtual void load(const Scene&, const Scheme&, double /*step_or_tolerance*/) {}
  virtual void step() {}                 // timed; of adaptive schemes one that the engine chooses
  virtual void advance(double /*t*/) {}  // timed; to a time that is a multiple of the step
  virtual void read(std::vector<double>& /*q*/, std::vector<double>& /*v*/) {}  // as in Scene
  // A step with clocks in it, which the timed one has not; of engines that can be looked into.
  virtual std::optional<SolverReading> watched_step() {
    step();
    return std::nullopt;
  }

  // ---- algorithms, on revolutes whose first body may be free ----
  // Timed are the algorithm and the passing of q, v, tau in the engine's own coordinates, which a
  // user of the engine pays as well; the conversion into them is not timed.
  virtual bool has(Algorithm) const { return false; }
  // How far its qdd may be from twinarm's in double, relative to the largest entry.
  virtual double tolerance(const Scene&) const { return 1e-9; }
  virtual void load_mechanism(const Scene& /*mechanism*/) {}     // once in the life of an engine
  virtual void set_situations(const std::vector<Situation>&) {}  // converts them; not timed
  virtual void run(Algorithm) {}                                 // timed: in each situation
  // Not timed: forward and inverse dynamics in situation k, as in Situation.
  virtual std::vector<double> qdd(std::size_t /*k*/) { return {}; }
  virtual std::vector<double> tau(std::size_t /*k*/) { return {}; }
};

// With steps of one size, which is nearly all.
class FixedStepEngine : public Engine {
 public:
  void advance(double t) override {
    while (t - static_cast<double>(steps_) * h_ > 0.5 * h_) step(), ++steps_;
  }

 protected:
  void begin(double h) { h_ = h, steps_ = 0; }
  double h_ = 0;
  long steps_ = 0;
};

using Engines = std::vector<std::unique_ptr<Engine>>;

struct EngineKind {
  std::string name;
  int order;          // of display; twinarm, against which all others are held, is the first
  Engines (*make)();  // its variants; the first one runs scenes, too
};
template <class E>
Engines one_engine() {
  Engines engines;
  engines.push_back(std::make_unique<E>());
  return engines;
}

std::vector<EngineKind> kinds_in_order();    // of this build
Engines all_engines();                       // all variants of them
std::vector<std::string> missing_engines();  // their libraries were not found

inline double thread_seconds() {  // CPU time of this thread [s]
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace twinarm::bench

namespace twinarm {

const std::vector<bench::EngineKind>& engine_kinds();  // made by twinarm_registry()

}  // namespace twinarm
