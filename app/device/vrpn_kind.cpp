#include "app/device/devices.h"
#include "app/device/vrpn_client.h"

namespace twinarm {
namespace {

VrpnAddress vrpn_address(const std::string& text) {
  const auto at = text.rfind('@');
  const std::string fix = "give the device's name and its server: vrpn:Phantom0@localhost:3883";
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    refuse_spec("vrpn:" + text, "expected NAME@HOST[:PORT]", fix);
  VrpnAddress address{text.substr(0, at), text.substr(at + 1)};
  if (address.device.size() > 99)
    refuse_spec("vrpn:" + text, "the name has more than 99 characters", fix);
  // A colon separates host and port, except in an IPv6 address without brackets.
  std::string& host = address.host;
  const auto colon = host.rfind(':');
  const bool bracketed = host.front() == '[' && host.find(']') != std::string::npos;
  if (colon != std::string::npos &&
      (bracketed ? colon > host.find(']') : host.find(':') == colon)) {
    const auto port = whole_number<int>(host.substr(colon + 1));
    if (!port || *port < 1 || *port > 65535)
      refuse_spec("vrpn:" + text, "the port is not a number from 1 to 65535", fix);
    address.port = *port;
    host.resize(colon);
  }
  if (bracketed) host = host.substr(1, host.find(']') - 1);
  if (host.empty()) refuse_spec("vrpn:" + text, "the host is missing", fix);
  return address;
}

}  // namespace

DeviceKind vrpn_kind() {
  return {.place = 50,
          .name = "vrpn",
          .argument = ":NAME@HOST[:PORT]",
          .help = "device of a VRPN server",
          .open =
              [](const std::string& address, const VirtualOmniSettings& settings) {
                return std::make_unique<VrpnDevice>(vrpn_address(address), settings.parameters);
              },
          .has_motors = true};
}

}  // namespace twinarm
