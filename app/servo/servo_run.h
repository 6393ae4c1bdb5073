// A scene under a hand: one tick of the servo loop.
//
//   device.poll -> watch, mapping -> KVR -> one step of the DVR with contacts -> force ->
//   device.render
//
// tick() neither waits, throws nor allocates once warm. Time is that of the run: tick n stands at n
// h, in real time or not.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/scene/forces/add_contacts.h"
#include "app/servo/haptic_loop.h"
#include "coupling/device/device_motion.h"
#include "solver/stepping/simulation.h"

namespace twinarm {

struct LiveOptions : HandLoopOptions {
  double step = 0;  // from 1e-6 to 0.1 s; 0: the scene's
};

// What a tick did, for the log and for whoever watches.
struct TickView {
  HandStep hand;  // what the KVR was told
  HandWatch::Mode mode = HandWatch::Mode::live;
  std::array<double, 3> felt{};   // torques of the motors [N m]
  std::array<double, 3> error{};  // q_K - q_D of the driven joints at the start of the step
  bool finite = true;             // false: the DVR has left all bounds, and stands
};

class LiveRun {
 public:
  // Scene and device must outlive it. Throws InputError: a step beyond its range, an integrator
  // that is not semi-implicit, contact = "event", no coupling with target = "device", couplings
  // that follow the device with different joints, a mapping that cannot move them.
  LiveRun(const SceneModel& scene, HandDevice& device, const LiveOptions& options);

  TickView tick() noexcept;
  double time() const { return simulation_.state().t; }
  double step() const { return h_; }
  const Simulation& simulation() const { return simulation_; }
  const SceneContacts& contacts() const { return *contacts_; }
  const HandWatch& watch() const { return loop_->watch(); }
  const DeviceMapping& mapping() const { return loop_->mapping(); }
  std::size_t leader() const { return leader_; }  // the first coupling that follows the device

 private:
  double h_;
  std::vector<std::size_t> led_;  // couplings that follow the device
  std::size_t leader_ = 0;
  std::unique_ptr<LiveHand> hand_;
  std::unique_ptr<SceneCouplings> couplings_;
  Simulation simulation_;
  std::optional<SceneContacts> contacts_;
  std::unique_ptr<HandLoop> loop_;
  bool stopped_ = false;
};

}  // namespace twinarm
