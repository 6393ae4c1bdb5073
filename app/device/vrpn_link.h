// Thread that exchanges messages with a VRPN server. Internal to app/device.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "app/device/file_descriptors.h"
#include "app/device/vrpn_client.h"
#include "app/device/vrpn_stream.h"
#include "coupling/device/triple_buffer.h"

namespace twinarm {

// For poll().
struct VrpnReport {
  double arrival = 0;  // of the newest pose, steady clock [s]
  long number = 0;     // of the newest pose; 0: none yet
  OmniAngles theta{};
  std::array<bool, 2> buttons{};
};

// From render().
struct VrpnForce {
  long number = 0;              // identifies a new one
  Vector3 F = Vector3::Zero();  // [N], device axes
};

class VrpnDevice::Link {
 public:
  Link(VrpnAddress address, const OmniParameters& parameters, VrpnSettings settings);
  ~Link();
  TripleBuffer<VrpnReport> reports{VrpnReport{}};  // written here
  TripleBuffer<VrpnForce> forces{VrpnForce{}};     // read here
  bool takes_forces() const { return takes_forces_; }
  VrpnCounts counts() const;

 private:
  struct Trouble {
    enum Kind { refused, silent, garbage, version, unknown, lost };
    Kind kind;
    std::string problem, fix;
  };
  void run();
  Trouble connect_and_run();
  Trouble run_connection(int socket);
  std::optional<Trouble> receive(int socket, VrpnStream& stream);
  std::optional<Trouble> send_pending(int socket);
  void take(const VrpnStream& stream);
  void count_skipped(const VrpnStream& stream);
  void send_force();
  std::optional<Trouble> timeout_trouble(const VrpnStream& stream) const;
  void report_start(std::optional<Trouble> trouble);
  void warn_once(unsigned kind, const std::string& text);
  bool wait(double seconds) const;  // false: stop requested

  VrpnAddress address_;
  OmniParameters parameters_;
  VrpnSettings settings_;
  std::string name_;  // DEVICE@HOST:PORT
  std::optional<TcpPeer> peer_;
  OwnedFd stop_;
  // Present connection.
  VrpnWriter writer_;
  VrpnBytes outbox_;
  bool described_ = false, sends_force_ = false;
  double last_pose_ = 0, last_force_ = 0;  // steady clock [s]
  long force_number_ = 0;
  long poses_taken_ = 0, skipped_counted_ = 0, malformed_counted_ = 0;
  VrpnReport report_;
  Vector3 stylus_ = Vector3::Zero();
  unsigned warned_ = 0;  // bit by kind
  std::atomic<bool> takes_forces_{false};
  std::atomic<long> connections_{0}, poses_{0}, not_finite_{0}, malformed_{0}, out_of_reach_{0},
      broken_{0};
  // Outcome of the first connection, for the constructor.
  std::mutex mutex_;
  std::condition_variable started_;
  bool is_started_ = false;
  std::optional<Trouble> first_trouble_;
  std::thread thread_;
};

}  // namespace twinarm
