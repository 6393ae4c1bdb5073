// A VRPN device over a real socket: handshake, poses, buttons, forces, and faulty peers. The
// server's bytes are not from our encoder (vrpn_bytes.h). Timeouts permit a loaded machine.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <set>

#include "app/device/vrpn_client.h"
#include "solver/support/diagnostics.h"
#include "tests/app/device/vrpn_server.h"
#include "tests/support/waiting.h"

using namespace twinarm;
using namespace vrpn_bytes;

namespace {

double test_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
// Polls at 1 kHz until a condition is met.
template <class Condition>
bool soon(VrpnDevice& device, const Condition& condition) {
  return comes_true([&] { return condition(device.poll(test_clock())); }, 1);
}

struct Said {
  std::mutex mutex;
  std::vector<std::string> lines;
  std::size_t count(const std::string& word) {
    const std::lock_guard lock(mutex);
    return static_cast<std::size_t>(std::count_if(
        lines.begin(), lines.end(), [&](const auto& l) { return l.find(word) != l.npos; }));
  }
};
// Short timeouts, but a silence longer than the delays of a loaded machine.
VrpnSettings quick(Said& said) {
  VrpnSettings settings;
  settings.silence = 0.8;
  settings.timeout = 1.5;
  settings.first_retry = 0.02;
  settings.longest_retry = 0.1;
  settings.warn = [&said](const std::string& line) {
    const std::lock_guard lock(said.mutex);
    said.lines.push_back(line);
  };
  return settings;
}
Diagnostic fault_of(const VrpnAddress& address) {
  Said said;
  try {
    const VrpnDevice device(address, {}, quick(said));
  } catch (const InputError& error) {
    REQUIRE(error.faults().size() == 1);
    return error.faults()[0];
  }
  return {};
}
bool has(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}
// theta1 = -atan2(x, z + L4) of the published kinematics.
Bytes pose_at_waist(double theta1) {
  const double R = 0.13335, L4 = 0.16835;
  return pose_with(0, -R * std::sin(theta1), pose_with(2, R * std::cos(theta1) - L4));
}

}  // namespace

TEST_CASE("VRPN device: sends the cookie, receives poses and buttons, announces its types") {
  Bytes first, device_name, force_name;
  std::atomic<bool> heard{false};
  VrpnServer server([&](const VrpnClient& client, int) {
    first = client.hear(24);
    client.say(all({greeting, pose, press_0}));
    device_name = client.hear_message();
    force_name = client.hear_message();
    heard = true;
    client.go_on(pose);
  });
  Said said;
  VrpnDevice device({"Phantom0", "127.0.0.1", server.port()}, {}, quick(said));
  CHECK(device.has_motors());
  CHECK(has(device.description(), "Phantom0"));
  CHECK(soon(device, [](const DeviceState& s) { return s.buttons[0]; }));
  CHECK(soon(device, [&](const DeviceState&) { return heard.load(); }));
  const double now = 1000;  // any clock: only differences are used
  const DeviceState state = device.poll(now);
  CHECK(state.alive);
  CHECK(std::abs(state.t - now) < 0.8);
  for (std::size_t j = 0; j < 3; ++j) CHECK(std::abs(state.theta[j]) < 1e-12);
  CHECK((state.stylus.p - Vector3(0, -0.11, -0.035)).norm() < 1e-12);
  CHECK((state.stylus.R - Matrix3::Identity()).norm() < 1e-12);
  CHECK_FALSE(state.buttons[1]);
  CHECK(first == cookie);
  CHECK(Bytes(device_name.begin() + 16, device_name.begin() + 20) == hex("ff ff ff ff"));
  CHECK(std::string(device_name.begin() + 28, device_name.begin() + 36) == "Phantom0");
  CHECK(std::string(force_name.begin() + 28, force_name.begin() + 56) ==
        "vrpn_ForceDevice Force_Field");
  CHECK(said.lines.empty());
}

TEST_CASE("VRPN device: reconnects after a connection cut within a pose, reported once") {
  VrpnServer server([&](const VrpnClient& client, int nth) {
    client.say(greeting);
    client.go_on(pose_at_waist(0.1 * nth), 4);
    if (nth < 3) return client.say(Bytes(pose.begin(), pose.begin() + 41));  // and close
    client.go_on(pose_at_waist(0.3));
  });
  Said said;
  VrpnDevice device({"Phantom0", "127.0.0.1", server.port()}, {}, quick(said));
  CHECK(soon(device, [](const DeviceState& s) { return std::abs(s.theta[0] - 0.3) < 1e-12; }));
  CHECK(device.counts().connections == 4);
  CHECK(device.counts().broken == 3);
  CHECK(said.count("retrying") == 1);  // noticed while receiving or while sending
}

TEST_CASE("VRPN device: invalid data during a run is counted, reported once, and survived") {
  Bytes absurd = pose;
  absurd[0] = 0x7f;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  VrpnServer server([&](const VrpnClient& client, int nth) {
    client.say(greeting);
    client.go_on(pose, 3);
    if (nth == 0) client.say(all({pose_with(1, nan), pose_with(1, nan), absurd}));
    if (nth == 1) client.say(Bytes(5000, 0xff));
    if (nth < 2) return client.hear_end();
    client.go_on(pose_with(0, 40.0), 60);  // 40 m away, for 0.3 s
    client.go_on(pose_at_waist(-0.5));
  });
  Said said;
  VrpnDevice device({"Phantom0", "127.0.0.1", server.port()}, {}, quick(said));
  CHECK(soon(device, [](const DeviceState& s) {
    for (const double theta : s.theta) CHECK_UNARY(std::isfinite(theta));
    return std::abs(s.theta[0] + 0.5) < 1e-12;
  }));
  const VrpnCounts counts = device.counts();
  CHECK(counts.not_finite == 2);
  CHECK(counts.out_of_reach > 0);  // of several poses in one packet the last is used
  CHECK(counts.broken == 2);
  CHECK(said.count("not finite") == 1);
  CHECK(said.count("invalid length") == 1);
  CHECK(said.count("out of reach") == 1);
}

TEST_CASE("VRPN device: not alive and at rest while silent, alive again with the next report") {
  std::atomic<bool> sends_poses{true};
  VrpnServer server([&](const VrpnClient& client, int) {
    client.say(greeting);
    while (!client.stopped()) client.go_on(pose_at_waist(0.3), sends_poses ? 1 : 0);
  });
  Said said;
  VrpnSettings settings = quick(said);
  settings.timeout = 30;  // the connection is kept
  VrpnDevice device({"Phantom0", "127.0.0.1", server.port()}, {}, settings);
  CHECK(soon(device, [](const DeviceState& s) { return s.alive; }));
  sends_poses = false;
  CHECK(soon(device, [](const DeviceState& s) { return !s.alive; }));
  const DeviceState still = device.poll(test_clock());
  CHECK(still.theta[0] == doctest::Approx(0.3));
  CHECK(test_clock() - still.t > 0.8);
  sends_poses = true;
  CHECK(soon(device, [](const DeviceState& s) { return s.alive; }));
  CHECK(device.counts().broken == 0);
}

TEST_CASE("VRPN device: not alive after the end of the server, and ends at once") {
  auto server = std::make_unique<VrpnServer>([&](const VrpnClient& client, int) {
    client.say(greeting);
    client.go_on(pose);
  });
  Said said;
  auto device = std::make_unique<VrpnDevice>(VrpnAddress{"Phantom0", "127.0.0.1", server->port()},
                                             OmniParameters{}, quick(said));
  server.reset();
  CHECK(soon(*device, [](const DeviceState& s) { return !s.alive; }));
  CHECK(soon(*device, [&](const DeviceState&) { return device->counts().broken > 2; }));
  CHECK(said.count("no connection") == 1);
  const double start = test_clock();
  device.reset();
  CHECK(test_clock() - start < 1);
}

TEST_CASE("VRPN device: closes a connection without data after its timeout") {
  VrpnServer server([&](const VrpnClient& client, int nth) {
    client.say(greeting);
    client.go_on(pose_at_waist(0.1 * nth), nth == 0 ? 5 : 1 << 20);
    client.hear_end();
  });
  Said said;
  VrpnDevice device({"Phantom0", "127.0.0.1", server.port()}, {}, quick(said));
  CHECK(soon(device, [](const DeviceState& s) { return std::abs(s.theta[0] - 0.1) < 1e-12; }));
  CHECK(said.count("no pose for 1.5 s") == 1);
}

TEST_CASE("VRPN device: an unavailable device is refused with a remedy") {
  const auto answer = [](const Bytes& bytes) {
    VrpnServer server([&](const VrpnClient& client, int) {
      client.say(bytes);
      client.hear_end();
    });
    return fault_of({"Phantom", "127.0.0.1", server.port()});
  };
  CHECK(has(answer(hex("48 54 54 50")).problem, "not a VRPN server"));
  CHECK(has(answer({}).problem, "no VRPN handshake"));
  Bytes other = cookie;
  other[12] = '6';
  CHECK(has(answer(other).problem, "06.38"));
  const Diagnostic unknown = answer(greeting);
  CHECK(has(unknown.problem, "unknown device 'Phantom'"));
  CHECK(has(unknown.fix, "Phantom0"));
  int port = 0;
  {
    const VrpnServer gone([](const VrpnClient&, int) {});
    port = gone.port();
  }
  const Diagnostic refused = fault_of({"Phantom0", "127.0.0.1", port});
  CHECK(has(refused.problem, "refused"));
  CHECK(has(refused.fix, "vrpn_server"));
  CHECK(has(fault_of({"Phantom0", "no.such.host.invalid", 3883}).problem, "unknown host"));
}

TEST_CASE("VRPN device: forces are sent in N at the stylus, limited, and end without render()") {
  std::mutex mutex;
  std::vector<std::array<float, 4>> forces;  // fx, fy, fz, radius
  VrpnServer server([&](const VrpnClient& client, int) {
    client.say(all({greeting, pose}));
    client.hear(24);
    std::thread poses([&] { client.go_on(pose); });
    while (!client.stopped()) {
      const Bytes message = client.hear_message();
      if (message.size() != 88) continue;
      const std::lock_guard lock(mutex);
      forces.push_back({float_at(message, 36), float_at(message, 40), float_at(message, 44),
                        float_at(message, 84)});
    }
    poses.join();
  });
  Said said;
  VrpnDevice device({"Phantom0", "127.0.0.1", server.port()}, {}, quick(said));
  const auto heard = [&](auto condition) {
    return soon(device, [&](const DeviceState&) {
      const std::lock_guard lock(mutex);
      return std::any_of(forces.begin(), forces.end(), condition);
    });
  };
  // At theta = 0 the waist's lever is L1, along -x: tau1 = -L1 Fx.
  device.render({{-0.13335 * 0.5, 0, 0}});
  CHECK(heard([](const auto& f) {
    return std::abs(f[0] - 0.5) < 1e-6 && std::abs(f[1]) < 1e-6 && std::abs(f[2]) < 1e-6 &&
           f[3] > 1;
  }));
  CHECK(heard([](const auto& f) { return f[3] == 0 && f[0] == 0; }));  // ended by the timeout
  device.render({{1.0, 0, 0}});                                        // -7.5 N
  CHECK(heard([](const auto& f) { return std::abs(f[0] + 3.3) < 1e-6; }));
  device.render({{std::numeric_limits<double>::quiet_NaN(), 0, 0}});
  const std::lock_guard lock(mutex);
  for (const auto& f : forces) CHECK_UNARY(std::hypot(f[0], f[1], f[2]) < 3.3 + 1e-5);
}

TEST_CASE("VRPN device: reports at 60 Hz are interpolated, without steps") {
  constexpr int reports = 40;
  std::atomic<bool> done{false};
  VrpnServer server([&](const VrpnClient& client, int) {
    client.say(all({greeting, pose}));
    for (int n = 0; n < reports; ++n) {
      std::this_thread::sleep_for(std::chrono::microseconds(16667));
      client.say(pose_at_waist(0.01 * n));
    }
    done = true;
    client.go_on(pose_at_waist(0.01 * (reports - 1)));
  });
  Said said;
  VrpnDevice device({"Phantom0", "127.0.0.1", server.port()}, {}, quick(said));
  std::set<double> angles;
  double last = 0, max_step = 0;
  while (!done) {
    const double theta = device.poll(test_clock()).theta[0];
    CHECK_UNARY(theta >= last - 1e-12);
    max_step = std::max(max_step, theta - last);
    angles.insert(last = theta);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  CHECK(soon(device, [](const DeviceState& s) {
    return std::abs(s.theta[0] - 0.01 * (reports - 1)) < 1e-12;
  }));
  CHECK(angles.size() > 2 * reports);
}
