// What the timing program knows of an engine. One .cpp file for each: engine_<name>.cpp.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/speed/models.h"

namespace twinarm::speed {

enum class Algorithm {
  forward_dynamics,  // qdd of q, v, tau
  inverse_dynamics,  // tau of q, v, qdd
  mass_matrix,       // of q, by the composite-rigid-body algorithm or what the engine has for it
  kinematics,        // of q: where every link is
  step               // one semi-implicit step of 1 ms, without contact
};
struct NamedAlgorithm {
  Algorithm algorithm;
  std::string_view name;
};
inline constexpr std::array<NamedAlgorithm, 5> algorithms = {{{Algorithm::forward_dynamics, "fd"},
                                                              {Algorithm::inverse_dynamics, "id"},
                                                              {Algorithm::mass_matrix, "crba"},
                                                              {Algorithm::kinematics, "fk"},
                                                              {Algorithm::step, "step"}}};

inline constexpr double step_length = 1e-3;  // [s]

// Written so that what is timed is the algorithm and the handing over of q, v, tau in the engine's
// own coordinates, which a user of the engine pays as well; the conversion into them is not timed.
class Engine {
 public:
  virtual ~Engine() = default;
  virtual std::string name() const = 0;
  virtual bool has(Algorithm) const = 0;
  // How far its qdd may be from twinarm's in double, relative to the largest entry.
  virtual double tolerance(const Mechanism&) const { return 1e-9; }

  virtual void load(const Mechanism&) = 0;                         // once in the life of an engine
  virtual void set_situations(const std::vector<Situation>&) = 0;  // converts them; not timed
  // Timed: runs the algorithm once in each of the situations.
  virtual void run(Algorithm) = 0;
  // Not timed: the answer of forward dynamics in situation k, ordered as Situation::qdd.
  virtual std::vector<double> qdd(std::size_t k) = 0;
  // Not timed: the answer of inverse dynamics in situation k, of the joints only.
  virtual std::vector<double> tau(std::size_t) { return {}; }
};

// Engines of this build, twinarm's first. The first one of all is twinarm in double.
using Engines = std::vector<std::unique_ptr<Engine>>;
Engines all_engines();

void add_twinarm(Engines&);
void add_mujoco(Engines&);
void add_bullet(Engines&);
void add_dart(Engines&);
void add_simbody(Engines&);

}  // namespace twinarm::speed
