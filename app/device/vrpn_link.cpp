#include "app/device/vrpn_link.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "app/support/files.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

constexpr double kForceRadius = 10;            // of the force field [m]
constexpr std::size_t kVrpnOutboxFull = 4096;  // unsent bytes: newer forces are dropped

// The angle plus multiples of 2 pi that is nearest to the last one.
double unwrapped(double angle, double last) {
  constexpr double period = 2 * std::numbers::pi;
  return angle - period * std::round((angle - last) / period);
}

}  // namespace

VrpnDevice::Link::Link(VrpnAddress address, const OmniParameters& parameters, VrpnSettings settings)
    : address_(std::move(address)),
      parameters_(parameters),
      settings_(std::move(settings)),
      name_(fmt::format("{}@{}:{}", address_.device, address_.host, address_.port)),
      stop_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!settings_.warn)
    settings_.warn = [](const std::string& line) { print_error("twinarm: {}\n", line); };
  try {
    peer_.emplace(address_.host, address_.port);
  } catch (const std::runtime_error& error) {
    throw InputError("--device vrpn:" + name_, fmt::format("unknown host: {}", error.what()),
                     "give its name or address: vrpn:NAME@HOST[:PORT]", "device.host-unknown");
  }
  thread_ = std::thread([this] { run(); });
  std::unique_lock lock(mutex_);
  started_.wait(lock, [this] { return is_started_; });
  if (!first_trouble_) return;
  lock.unlock();
  thread_.join();
  throw InputError("--device vrpn:" + name_, first_trouble_->problem, first_trouble_->fix,
                   "device.no-answer");
}

VrpnDevice::Link::~Link() {
  const std::uint64_t one = 1;
  while (write(stop_.get(), &one, sizeof one) < 0 && errno == EINTR) {
  }
  thread_.join();
}

VrpnCounts VrpnDevice::Link::counts() const {
  return {connections_, poses_, not_finite_, malformed_, out_of_reach_, broken_};
}

bool VrpnDevice::Link::wait(double seconds) const {
  pollfd stop{stop_.get(), POLLIN, 0};
  ::poll(&stop, 1, static_cast<int>(std::ceil(1000 * seconds)));
  return stop.revents == 0;
}

void VrpnDevice::Link::run() {
  double retry = settings_.first_retry;
  do {
    const long before = poses_;
    const Trouble trouble = [&]() -> Trouble {
      try {
        return connect_and_run();
      } catch (const std::exception& error) {
        return {Trouble::lost, error.what(), "restart the server"};
      }
    }();
    bool first = false;
    {
      const std::lock_guard lock(mutex_);
      first = !is_started_;
    }
    if (first) return report_start(trouble);
    if (!wait(0)) return;
    ++broken_;
    warn_once(trouble.kind, trouble.problem + "; retrying (reported once, counted)");
    retry = poses_ > before ? settings_.first_retry : std::min(2 * retry, settings_.longest_retry);
  } while (wait(retry));
}

void VrpnDevice::Link::report_start(std::optional<Trouble> trouble) {
  const std::lock_guard lock(mutex_);
  if (is_started_) return;
  is_started_ = true;
  first_trouble_ = std::move(trouble);
  started_.notify_one();
}

void VrpnDevice::Link::warn_once(unsigned kind, const std::string& text) {
  if ((warned_ >> kind & 1u) != 0) return;
  warned_ |= 1u << kind;
  settings_.warn(name_ + ": " + text);
}

VrpnDevice::Link::Trouble VrpnDevice::Link::connect_and_run() {
  std::string why_not;
  const OwnedFd socket = peer_->connect(settings_.timeout, stop_.get(), why_not);
  if (socket.get() < 0)
    return {Trouble::refused, fmt::format("no connection: {}", why_not),
            fmt::format("start vrpn_server on {} or give its port: vrpn:NAME@HOST:PORT",
                        address_.host)};
  const Trouble end = run_connection(socket.get());
  if (sends_force_) {  // ends the force, if still possible
    outbox_.clear();
    writer_.force(outbox_, Vector3::Zero(), Vector3::Zero(), 0);
    [[maybe_unused]] const auto sent =
        send(socket.get(), outbox_.data(), outbox_.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  }
  return end;
}

VrpnDevice::Link::Trouble VrpnDevice::Link::run_connection(int socket) {
  VrpnStream stream(address_.device);
  writer_ = VrpnWriter();
  outbox_.clear();
  writer_.cookie(outbox_);
  described_ = sends_force_ = false;
  poses_taken_ = skipped_counted_ = malformed_counted_ = 0;
  last_pose_ = steady_seconds();
  while (true) {
    if (described_) send_force();
    if (auto trouble = send_pending(socket)) return *trouble;
    pollfd ready[2] = {{socket, static_cast<short>(outbox_.empty() ? POLLIN : POLLIN | POLLOUT), 0},
                       {stop_.get(), POLLIN, 0}};
    ::poll(ready, 2, sends_force_ ? 1 : 10);  // [ms]; then forces are sent
    if (ready[1].revents != 0) return {Trouble::lost, "stopped", ""};
    if (ready[0].revents != 0)
      if (auto trouble = receive(socket, stream)) return *trouble;
    if (auto trouble = timeout_trouble(stream)) return *trouble;
  }
}

std::optional<VrpnDevice::Link::Trouble> VrpnDevice::Link::receive(int socket, VrpnStream& stream) {
  std::array<std::uint8_t, 4096> bytes{};
  const auto count = recv(socket, bytes.data(), bytes.size(), 0);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
  if (count <= 0)
    return Trouble{Trouble::lost, "the server closed the connection",
                   "see the output of the server"};
  const bool had_cookie = !stream.version().empty();
  const auto fault = stream.feed(bytes.data(), static_cast<std::size_t>(count));
  if (!had_cookie && !stream.version().empty() && fault != VrpnStream::Error::other_version)
    ++connections_;
  take(stream);
  switch (fault) {
    case VrpnStream::Error::none:
      return std::nullopt;
    case VrpnStream::Error::not_vrpn:
      return Trouble{Trouble::garbage, "the peer is not a VRPN server",
                     "give the port of a VRPN server, 3883 by default"};
    case VrpnStream::Error::other_version:
      return Trouble{Trouble::version,
                     fmt::format("the server has version '{}'; supported: 07", stream.version()),
                     "use a VRPN 7 server"};
    case VrpnStream::Error::bad_length:
      return Trouble{Trouble::garbage, "the server sent a message of invalid length",
                     "check which program listens on that port"};
    case VrpnStream::Error::goodbye:
      break;
  }
  return Trouble{Trouble::lost, "the server ended the connection", "start it again"};
}

std::optional<VrpnDevice::Link::Trouble> VrpnDevice::Link::send_pending(int socket) {
  if (outbox_.empty()) return std::nullopt;
  const auto sent = send(socket, outbox_.data(), outbox_.size(), MSG_NOSIGNAL);
  if (sent >= 0) {
    outbox_.erase(outbox_.begin(), outbox_.begin() + sent);
  } else if (errno != EAGAIN && errno != EINTR) {
    return Trouble{Trouble::lost, "the server does not accept data any more",
                   "see the output of the server"};
  }
  return std::nullopt;
}

std::optional<VrpnDevice::Link::Trouble> VrpnDevice::Link::timeout_trouble(
    const VrpnStream& stream) const {
  if (steady_seconds() - last_pose_ < settings_.timeout) return std::nullopt;
  if (stream.version().empty())
    return Trouble{Trouble::silent, "no VRPN handshake from the peer",
                   "give the port of a VRPN server, 3883 by default"};
  if (!stream.has_device())
    return Trouble{Trouble::unknown,
                   fmt::format("unknown device '{}' of the server", address_.device),
                   name_remedy(address_.device, stream.devices(), "devices")};
  return Trouble{Trouble::silent, fmt::format("no pose for {:g} s", settings_.timeout),
                 "switch on the device, calibrate it, and move its stylus"};
}

void VrpnDevice::Link::take(const VrpnStream& stream) {
  count_skipped(stream);
  const bool moved = stream.poses() > poses_taken_;
  // Sends our names after the server sent its own, which come before the first pose: names sent
  // earlier would create new devices in the server.
  if (moved && !std::exchange(described_, true)) {
    const bool takes_rates = stream.knows_type(VrpnWriter::kRateName);
    takes_forces_ = stream.knows_type(VrpnWriter::kForceName);
    writer_.describe(outbox_, address_.device, takes_forces_, takes_rates);
    if (takes_rates) writer_.request_rate(outbox_, settings_.rate);
  }
  if (moved) {
    poses_ += stream.poses() - poses_taken_;
    poses_taken_ = stream.poses();
    last_pose_ = report_.arrival = steady_seconds();
    ++report_.number;
    stylus_ = stream.pose().p;
    if (const auto theta = omni_inverse(parameters_, stream.pose())) {
      for (std::size_t j = 0; j < 6; ++j)
        report_.theta[j] = unwrapped((*theta)[j], report_.theta[j]);
    } else {
      ++out_of_reach_;
      warn_once(8, "a pose is out of reach; the angles stay (reported once, counted)");
    }
  }
  if (!moved && stream.buttons() == report_.buttons) return;
  report_.buttons = stream.buttons();
  reports.write(report_);
  if (moved) report_start(std::nullopt);
}

void VrpnDevice::Link::count_skipped(const VrpnStream& stream) {
  not_finite_ += stream.not_finite() - skipped_counted_;
  malformed_ += stream.malformed() - malformed_counted_;
  skipped_counted_ = stream.not_finite();
  malformed_counted_ = stream.malformed();
  if (stream.not_finite() > 0)
    warn_once(9, "a pose is not finite or not a rotation; skipped (reported once, counted)");
  if (stream.malformed() > 0)
    warn_once(10, "a message has the wrong length for its type; skipped (reported once, counted)");
}

void VrpnDevice::Link::send_force() {
  if (!takes_forces_) return;
  const double now = steady_seconds();
  const VrpnForce& newest = forces.read();
  if (newest.number != force_number_) {
    force_number_ = newest.number;
    last_force_ = now;
    if (outbox_.size() > kVrpnOutboxFull) return;
    sends_force_ = true;
    writer_.force(outbox_, stylus_, newest.F, kForceRadius);
  } else if (sends_force_ && now - last_force_ > settings_.force_timeout) {
    sends_force_ = false;
    writer_.force(outbox_, stylus_, Vector3::Zero(), 0);
  }
}

}  // namespace twinarm
