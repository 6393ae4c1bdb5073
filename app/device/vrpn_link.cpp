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

constexpr double kForceRadius = 10;            // a field as wide as any room [m]
constexpr std::size_t kVrpnOutboxFull = 4096;  // unsent bytes: newer forces are dropped

// The same angle, less than half a turn from the last one: the inverse kinematics knows no turns.
double unwrapped(double angle, double last) {
  constexpr double turn = 2 * std::numbers::pi;
  return angle - turn * std::round((angle - last) / turn);
}

}  // namespace

VrpnDevice::Link::Link(VrpnAddress address, const OmniParameters& figures, VrpnSettings settings)
    : address_(std::move(address)),
      figures_(figures),
      settings_(std::move(settings)),
      name_(fmt::format("{}@{}:{}", address_.device, address_.host, address_.port)),
      stop_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!settings_.say) settings_.say = [](const std::string& line) { say("twinarm: {}\n", line); };
  try {
    peer_.emplace(address_.host, address_.port);
  } catch (const std::runtime_error& error) {
    throw InputError(
        {{"", 0, "--device vrpn:" + name_, fmt::format("the host is not known: {}", error.what()),
          "give its name or address: vrpn:NAME@HOST[:PORT]", "device.host-unknown"}});
  }
  thread_ = std::thread([this] { run(); });
  std::unique_lock lock(mutex_);
  decided_.wait(lock, [this] { return is_decided_; });
  if (!first_trouble_) return;
  lock.unlock();
  thread_.join();
  throw InputError({{"", 0, "--device vrpn:" + name_, first_trouble_->problem, first_trouble_->fix,
                     "device.no-answer"}});
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

// One connection after the other. Only here, and in what it calls, the thread may allocate.
void VrpnDevice::Link::run() {
  double retry = settings_.first_retry;
  do {
    const long before = poses_;
    const Trouble trouble = talk();
    bool first = false;
    {
      const std::lock_guard lock(mutex_);
      first = !is_decided_;
    }
    if (first) return decide(trouble);
    if (!wait(0)) return;
    ++broken_;
    tell_trouble(trouble);
    retry = poses_ > before ? settings_.first_retry : std::min(2 * retry, settings_.longest_retry);
  } while (wait(retry));
}

void VrpnDevice::Link::decide(std::optional<Trouble> trouble) {
  const std::lock_guard lock(mutex_);
  if (is_decided_) return;
  is_decided_ = true;
  first_trouble_ = std::move(trouble);
  decided_.notify_one();
}

void VrpnDevice::Link::say_once(unsigned kind, const std::string& text) {
  if ((said_ >> kind & 1u) != 0) return;
  said_ |= 1u << kind;
  settings_.say(name_ + ": " + text);
}

void VrpnDevice::Link::tell_trouble(const Trouble& trouble) {
  say_once(trouble.kind, trouble.problem + "; trying again (said once, counted)");
}

VrpnDevice::Link::Trouble VrpnDevice::Link::talk() {
  std::string why_not;
  const OwnedFd socket = peer_->connect(settings_.patience, stop_.get(), why_not);
  if (socket.get() < 0)
    return {Trouble::refused, fmt::format("no connection: {}", why_not),
            fmt::format("start vrpn_server on {} or give its port: vrpn:NAME@HOST:PORT",
                        address_.host)};
  const Trouble end = converse(socket.get());
  if (pushing_) {  // the last word, where it can still be said
    outbox_.clear();
    speech_.force(outbox_, Vector3::Zero(), Vector3::Zero(), 0);
    [[maybe_unused]] const auto sent =
        send(socket.get(), outbox_.data(), outbox_.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  }
  return end;
}

VrpnDevice::Link::Trouble VrpnDevice::Link::converse(int socket) {
  VrpnStream stream(address_.device);
  speech_ = VrpnSpeech();
  outbox_.clear();
  speech_.cookie(outbox_);
  described_ = pushing_ = false;
  poses_taken_ = skipped_told_ = malformed_told_ = 0;
  last_pose_ = steady_seconds();
  while (true) {
    if (described_) send_force();
    if (auto trouble = speak(socket)) return *trouble;
    pollfd ready[2] = {{socket, static_cast<short>(outbox_.empty() ? POLLIN : POLLIN | POLLOUT), 0},
                       {stop_.get(), POLLIN, 0}};
    ::poll(ready, 2, pushing_ ? 1 : 10);  // [ms]: forces are looked for in between
    if (ready[1].revents != 0) return {Trouble::lost, "stopped", ""};
    if (ready[0].revents != 0)
      if (auto trouble = listen(socket, stream)) return *trouble;
    if (auto trouble = impatience(stream)) return *trouble;
  }
}

std::optional<VrpnDevice::Link::Trouble> VrpnDevice::Link::listen(int socket, VrpnStream& stream) {
  std::array<std::uint8_t, 4096> bytes{};
  const auto count = recv(socket, bytes.data(), bytes.size(), 0);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
  if (count <= 0)
    return Trouble{Trouble::lost, "the server has closed the connection",
                   "look at the server's own output"};
  const bool was_greeted = !stream.version().empty();
  const auto fault = stream.feed(bytes.data(), static_cast<std::size_t>(count));
  if (!was_greeted && !stream.version().empty() && fault != VrpnStream::Diagnostic::other_version)
    ++connections_;
  take(stream);
  switch (fault) {
    case VrpnStream::Diagnostic::none:
      return std::nullopt;
    case VrpnStream::Diagnostic::not_vrpn:
      return Trouble{Trouble::garbage, "what answers there is no VRPN server",
                     "give the port of a VRPN server, 3883 by default"};
    case VrpnStream::Diagnostic::other_version:
      return Trouble{Trouble::version,
                     fmt::format("the server speaks '{}', we speak 07", stream.version()),
                     "use a server of VRPN 7"};
    case VrpnStream::Diagnostic::bad_length:
      return Trouble{Trouble::garbage, "the server sends a message of an impossible length",
                     "look at what listens on that port"};
    case VrpnStream::Diagnostic::goodbye:
      break;
  }
  return Trouble{Trouble::lost, "the server has said goodbye", "start it again"};
}

std::optional<VrpnDevice::Link::Trouble> VrpnDevice::Link::speak(int socket) {
  if (outbox_.empty()) return std::nullopt;
  const auto sent = send(socket, outbox_.data(), outbox_.size(), MSG_NOSIGNAL);
  if (sent >= 0) {
    outbox_.erase(outbox_.begin(), outbox_.begin() + sent);
  } else if (errno != EAGAIN && errno != EINTR) {
    return Trouble{Trouble::lost, "the server does not listen any more",
                   "look at the server's own output"};
  }
  return std::nullopt;
}

std::optional<VrpnDevice::Link::Trouble> VrpnDevice::Link::impatience(
    const VrpnStream& stream) const {
  if (steady_seconds() - last_pose_ < settings_.patience) return std::nullopt;
  if (stream.version().empty())
    return Trouble{Trouble::silent, "what listens there does not answer as a VRPN server",
                   "give the port of a VRPN server, 3883 by default"};
  if (!stream.has_device())
    return Trouble{Trouble::unknown, fmt::format("the server has no device '{}'", address_.device),
                   name_remedy(address_.device, stream.devices(), "devices")};
  return Trouble{Trouble::silent, fmt::format("no pose for {:g} s", settings_.patience),
                 "switch the device on, calibrate it, and move its stylus"};
}

// Our names go out once the server has told its own, which come before the first pose: before, it
// would take ours for new devices, and tell us of them.
void VrpnDevice::Link::greet_device(const VrpnStream& stream) {
  if (described_) return;
  described_ = true;
  const bool takes_rates = stream.knows_type(VrpnSpeech::kRateName);
  takes_forces_ = stream.knows_type(VrpnSpeech::kForceName);
  speech_.describe(outbox_, address_.device, takes_forces_, takes_rates);
  if (takes_rates) speech_.ask_rate(outbox_, settings_.rate);
}

void VrpnDevice::Link::take(const VrpnStream& stream) {
  note_skipped(stream);
  const bool moved = stream.poses() > poses_taken_;
  if (moved) {
    greet_device(stream);
    poses_ += stream.poses() - poses_taken_;
    poses_taken_ = stream.poses();
    last_pose_ = report_.arrival = steady_seconds();
    ++report_.number;
    stylus_ = stream.pose().p;
    if (const auto theta = omni_inverse(figures_, stream.pose())) {
      for (std::size_t j = 0; j < 6; ++j)
        report_.theta[j] = unwrapped((*theta)[j], report_.theta[j]);
    } else {
      ++out_of_reach_;
      say_once(8, "a pose is out of the arm's reach; the angles stay (said once, counted)");
    }
  }
  if (!moved && stream.buttons() == report_.buttons) return;
  report_.buttons = stream.buttons();
  reports.write(report_);
  if (moved) decide(std::nullopt);
}

void VrpnDevice::Link::note_skipped(const VrpnStream& stream) {
  not_finite_ += stream.not_finite() - skipped_told_;
  malformed_ += stream.malformed() - malformed_told_;
  skipped_told_ = stream.not_finite();
  malformed_told_ = stream.malformed();
  if (stream.not_finite() > 0)
    say_once(9, "a pose is not finite or not a rotation; skipped (said once, counted)");
  if (stream.malformed() > 0)
    say_once(10, "a message is not as long as its type is; skipped (said once, counted)");
}

void VrpnDevice::Link::send_force() {
  if (!takes_forces_) return;
  const double now = steady_seconds();
  const VrpnForce& newest = forces.read();
  if (newest.number != force_number_) {
    force_number_ = newest.number;
    last_force_ = now;
    if (outbox_.size() > kVrpnOutboxFull) return;
    pushing_ = true;
    speech_.force(outbox_, stylus_, newest.F, kForceRadius);
  } else if (pushing_ && now - last_force_ > settings_.let_go) {
    pushing_ = false;
    speech_.force(outbox_, stylus_, Vector3::Zero(), 0);
  }
}

}  // namespace twinarm
