// What is asked of an engine that runs a scene. One .cpp file for each: peer_<name>.cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "benchmarks/peers/peer_scene.h"

namespace twinarm::peers {

// By what a scene is run: a step of fixed size, or a tolerance of an adaptive scheme.
struct Scheme {
  std::string name;
  bool adaptive = false;
};

class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;
  // Those that can run the scene, the one that the engine comes with first; none: see refusal().
  virtual std::vector<Scheme> schemes(const Scene&) const = 0;
  virtual std::string refusal(const Scene&) const { return {}; }  // why it cannot express it

  virtual void load(const Scene&, const Scheme&, double step_or_tolerance) = 0;
  virtual void step() = 0;             // timed; of adaptive schemes one that the engine chooses
  virtual void advance(double t) = 0;  // timed; to a time that is a multiple of the step
  virtual void read(std::vector<double>& q, std::vector<double>& v) = 0;  // as in Scene
};

// With steps of one size, which is nearly all.
class FixedStepPeer : public Peer {
 public:
  void advance(double t) override {
    while (t - static_cast<double>(steps_) * h_ > 0.5 * h_) step(), ++steps_;
  }

 protected:
  void begin(double h) { h_ = h, steps_ = 0; }
  double h_ = 0;
  long steps_ = 0;
};

// Of this build, twinarm first; and the names of those whose library was not found.
using Peers = std::vector<std::unique_ptr<Peer>>;
Peers all_peers();
std::vector<std::string> missing_peers();

void add_twinarm(Peers&);
void add_mujoco(Peers&);
void add_bullet(Peers&);
void add_dart(Peers&);
void add_simbody(Peers&);
void add_ode(Peers&);

}  // namespace twinarm::peers
