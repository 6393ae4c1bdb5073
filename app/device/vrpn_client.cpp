
#include <fmt/format.h>

#include <algorithm>

#include "app/device/vrpn_link.h"
#include "app/support/progress.h"

namespace twinarm {

// Bounds of the assumed report interval [s].
constexpr double kMinReport = 0.5e-3, kLongestReport = 50e-3;
constexpr double kFirstReport = 1.0 / 60;  // before the second report
constexpr double kReportShare = 1.0 / 8;   // of the newest interval in the running mean

VrpnDevice::VrpnDevice(const VrpnAddress& address, const OmniParameters& parameters,
                       const VrpnSettings& settings)
    : link_(std::make_unique<Link>(address, parameters, settings)),
      parameters_(parameters),
      description_(
          fmt::format("VRPN device {} at {}:{}", address.device, address.host, address.port)),
      silence_(settings.silence),
      interval_(kFirstReport) {}

VrpnDevice::~VrpnDevice() = default;

DeviceState VrpnDevice::poll(double now) noexcept {
  const double clock = steady_seconds();
  const VrpnReport& report = link_->reports.read();
  if (report.number != seen_) {
    const double interval = report.arrival - start_;
    const bool goes_on = seen_ > 0 && interval < silence_;
    if (goes_on)
      interval_ += kReportShare * (std::clamp(interval, kMinReport, kLongestReport) - interval_);
    from_ = goes_on ? at_ : report.theta;  // a jump after a silence
    to_ = report.theta;
    start_ = report.arrival;
    seen_ = report.number;
  }
  const double s = std::clamp((clock - start_) / interval_, 0.0, 1.0);
  for (std::size_t j = 0; j < 6; ++j) at_[j] = from_[j] + s * (to_[j] - from_[j]);

  DeviceState state;
  const double age = clock - report.arrival;
  state.t = now - age;
  state.theta = at_;
  state.stylus = omni_stylus(parameters_, at_);
  state.buttons = report.buttons;
  state.alive = seen_ > 0 && age < silence_;
  return state;
}

void VrpnDevice::render(const DeviceForce& force) noexcept {
  const auto torque = omni_limit(parameters_, at_, force.torque);
  link_->forces.write({++rendered_, omni_force(parameters_, at_, torque)});
}

bool VrpnDevice::has_motors() const {
  return link_->takes_forces();
}

VrpnCounts VrpnDevice::counts() const {
  return link_->counts();
}

}  // namespace twinarm
