// What the timing of contact scenes knows of an engine. One .cpp file for each:
// contact_<name>.cpp.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/speed/contact_scene.h"

namespace twinarm::speed {

// What twinarm's solver says of itself.
struct SolverReading {
  double residual = 0;  // of the laws of contact [m/s]
  bool converged = true;
  double detection = 0, solver = 0, whole = 0;  // where the time of the step went [s]
};

class ContactEngine {
 public:
  virtual ~ContactEngine() = default;
  virtual std::string name() const = 0;
  virtual void load(const ContactScene& scene) = 0;  // also to its start again
  virtual void step() = 0;                           // timed, control of the arm included
  virtual std::vector<Placed> bodies() const = 0;
  // A step with clocks in it, which the timed one has not; of engines that can be looked into.
  virtual std::optional<SolverReading> watched_step() {
    step();
    return std::nullopt;
  }
};

using ContactEngines = std::vector<std::unique_ptr<ContactEngine>>;
ContactEngines all_contact_engines();  // of this build, twinarm's first

void add_twinarm(ContactEngines&);
void add_mujoco(ContactEngines&);
void add_bullet(ContactEngines&);

double thread_seconds();  // CPU time of this thread [s]

}  // namespace twinarm::speed
