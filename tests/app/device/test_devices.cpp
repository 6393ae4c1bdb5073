// Devices by name, and invalid names.
#include <doctest/doctest.h>

#include <filesystem>

#include "app/device/devices.h"
#include "coupling/target/recorded_trace.h"
#include "coupling/target/synthetic_operator.h"
#include "solver/support/diagnostics.h"

using namespace twinarm;

namespace {

Diagnostic device_fault(const std::string& spec) {
  try {
    open_device(spec);
  } catch (const InputError& error) {
    REQUIRE(error.faults().size() == 1);
    return error.faults()[0];
  }
  return {};
}
bool tells(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

}  // namespace

TEST_CASE("device list: contains every kind and every scripted motion") {
  const std::string list = device_list();
  for (const DeviceKind& kind : device_kinds()) {
    CHECK(tells(list, kind.name + kind.argument));
    CHECK(tells(list, kind.help));
  }
  for (const ScriptedMotion& motion : scripted_motions()) CHECK(tells(list, motion.help));
  CHECK(device_kinds().size() == 5);
  CHECK(scripted_motions().size() == 6);
}

TEST_CASE("devices: only motions without a file open no file, device or socket") {
  for (const char* spec : {"virtual", "virtual:paper", "virtual:synthetic:7", "virtual:chirp"})
    CHECK_UNARY(stays_inside(spec));
  for (const char* spec : {"virtual:trace:/etc/passwd", "keyboard", "keyboard:/dev/tty1", "gamepad",
                           "spacemouse:/tmp/socket", "vrpn:Phantom0@lab"})
    CHECK_UNARY_FALSE(stays_inside(spec));
  CHECK_THROWS_AS(stays_inside("ouija"), InputError);
  CHECK_THROWS_AS(stays_inside("virtual:ouija"), InputError);
}

TEST_CASE("devices: every scripted motion keeps a virtual Omni within its joint ranges") {
  const std::string trace =
      (std::filesystem::temp_directory_path() / "twinarm-devices-trace.csv").string();
  write_trace(SyntheticOperator(5, 3), 100, trace);
  for (const ScriptedMotion& motion : scripted_motions()) {
    CAPTURE(motion.name);
    const std::string spec = "virtual:" + motion.name + (motion.name == "trace" ? ":" + trace : "");
    const auto device = open_device(spec);
    CHECK(device->has_motors());
    double low = 1e9, high = -1e9;
    for (int n = 0; n < 3000; ++n) {
      const DeviceState state = device->poll(0.001 * n);
      CHECK_UNARY(state.alive);
      for (std::size_t j = 0; j < 3; ++j) {
        CHECK_UNARY(state.theta[j] > device->parameters().lower[j] - 1e-3);
        CHECK_UNARY(state.theta[j] < device->parameters().upper[j] + 1e-3);
      }
      low = std::min(low, state.theta[0]);
      high = std::max(high, state.theta[0]);
    }
    CHECK(high - low > 0.05);
  }
  std::filesystem::remove(trace);
}

TEST_CASE("devices: unknown names are refused with the nearest known one") {
  CHECK(tells(device_fault("keybord").fix, "keyboard"));
  CHECK(tells(device_fault("virtual:papper").fix, "paper"));
  CHECK(tells(device_fault("virtual:synthetic:x").problem, "whole number"));
  CHECK(tells(device_fault("virtual:step:3").problem, "no argument"));
  CHECK(tells(device_fault("virtual:trace").problem, "file is missing"));
  CHECK(tells(device_fault("virtual:trace:/nowhere.csv").file, "nowhere.csv"));
  CHECK_FALSE(device_fault("").problem.empty());
}

TEST_CASE("devices: an invalid VRPN address is refused before connecting") {
  for (const char* address :
       {"", "Phantom0", "@host", "Phantom0@", "Phantom0@:3883", "Phantom0@host:", "Phantom0@host:0",
        "Phantom0@host:65536", "Phantom0@host:12x"}) {
    CAPTURE(address);
    CHECK(tells(device_fault(std::string("vrpn:") + address).fix, "vrpn:Phantom0@localhost:3883"));
  }
  CHECK(tells(device_fault("vrpn:P@[::1]:1").problem, "no connection"));  // port 1 is closed
  CHECK(tells(device_fault("vrpn:P@127.0.0.1:1").problem, "refused"));
}

TEST_CASE("devices: a missing device or daemon is reported with a remedy") {
  CHECK(tells(device_fault("gamepad:/dev/input/no-such-js").fix, "connect"));
  CHECK(tells(device_fault("spacemouse:/no/such/socket").fix, "spacenavd"));
  CHECK(tells(device_fault("spacemouse:/" + std::string(300, 'x')).problem, "too long"));
  CHECK(tells(device_fault("keyboard:/dev/null").problem, "not a terminal"));
  CHECK(tells(device_fault("keyboard:/no/such/terminal").fix, "terminal"));
}
