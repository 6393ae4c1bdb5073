// What a page sees of the scenes of a contact case while it runs: readings and energy over time, or
// the same runs with another step. Without a recorder nothing is noted, and a case is what it is.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace twinarm {

class ContactScene;

// Of one scene; evenly spaced steps, thinned to some hundreds.
struct ContactRun {
  std::vector<double> t, energy;          // [s], kinetic and potential [J]
  std::vector<std::vector<double>> seen;  // by reading, then by t
  double tried = 0;                       // in a search for a limit: the value, and its outcome
  bool holds = false;
};

// Ends the experiment by an Enough that comes out of start(), step() or threshold(), once all that
// was asked for is there.
class ContactRecorder {
 public:
  struct Enough {};
  std::function<std::vector<double>(const ContactScene&)> look{};  // null: nothing is noted
  std::size_t count = 1;    // of the runs to note; in a search always two, one of each outcome
  std::size_t every = 1;    // the scenes of a case of which one is noted
  double until = HUGE_VAL;  // [s]
  bool search = false;
  double step_scale = 1;  // all steps are longer by it
  std::vector<ContactRun> runs{};

  void begin(const ContactScene& scene);
  void note(const ContactScene& scene, double energy);
  void outcome(double tried, bool holds);

 private:
  void add(const ContactScene& scene, double energy);
  std::size_t begun_ = 0, steps_ = 0, stride_ = 1;
  bool active_ = false;
};

// That of the scenes that this thread makes; null: none.
inline thread_local ContactRecorder* contact_recorder = nullptr;

}  // namespace twinarm
