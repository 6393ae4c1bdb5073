#include "app/servo/haptic_loop.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <ctime>

namespace twinarm {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

std::int64_t nanoseconds_of(clockid_t clock) noexcept {
  timespec time{};
  clock_gettime(clock, &time);
  return time.tv_sec * kSecond + time.tv_nsec;
}

}  // namespace

std::vector<int> driven_bodies(const SceneModel& scene, const DrivenJoints& joints) {
  std::vector<int> bodies;
  for (const std::string& name : joints.turned) bodies.push_back(scene.model.find_joint(name));
  return bodies;
}

std::pair<int, Vector3> controlled_point(const SceneModel& scene,
                                         const std::vector<std::size_t>& driven) {
  const std::vector<int> bodies = driven_bodies(scene, scene.couplings[driven.front()].driven);
  const auto last = static_cast<std::size_t>(bodies.back());
  const bool is_end = scene.model.last_child[last] == 0;  // its origin is on its own axis
  std::pair<int, Vector3> point{bodies.back(),
                                is_end ? com_of_link(scene.model, last) : Vector3::Zero()};
  for (const std::size_t c : driven)
    if (scene.couplings[c].is_linear())
      point = {scene.couplings[c].spring.body, scene.couplings[c].spring.p_L};
  return point;
}

HapticLoop::HapticLoop(const SceneModel& scene, const SceneCouplings& couplings,
                       const std::vector<std::size_t>& driven, InputDevice& device,
                       const HapticLoopOptions& options)
    : model_(scene.model),
      couplings_(couplings),
      device_(device),
      first_(driven.front()),
      driven_(driven_bodies(scene, scene.couplings[first_].driven)),
      reaction_(scene.model, driven_) {
  const auto [body, p_L] = controlled_point(scene, driven);
  const State<double>& rest = scene.couplings[first_].rest;
  const MappedRobot robot{&scene.model, rest, driven_, {}, {}, body, p_L};
  mapping_ = make_mapping(options.mapping, device.parameters(), robot);
  force_ = std::make_unique<ForceFeedback>(options.force, device.parameters(), *mapping_);
  for (const std::size_t c : driven)
    if (scene.couplings[c].is_first_component() && !scene.couplings[c].soft_limits)
      reaction_.add(couplings.law(c), couplings.coupling(c));
  for (const int joint : driven_) {
    target_.q.push_back(rest.q[scene.model.iq[static_cast<std::size_t>(joint)]]);
    target_.qd.push_back(0);
    q_D_.push_back(target_.q.back());
  }
}

void HapticLoop::begin(const std::vector<double>& q, double now) noexcept {
  std::copy(q.begin(), q.end(), target_.q.begin());
  mapping_->begin(device_.poll(now), target_.q);
}

const MappedTarget& HapticLoop::before_step(const State<double>& x, double now, double h) noexcept {
  state_ = device_.poll(now);
  for (std::size_t j = 0; j < driven_.size(); ++j)
    q_D_[j] = x.q[model_.iq[static_cast<std::size_t>(driven_[j])]];
  watch_.tick(state_, *mapping_, q_D_, h, target_);
  return target_;
}

const DeviceForce& HapticLoop::after_step(const Simulation& simulation, double h,
                                          bool finite) noexcept {
  rendered_ = {};
  if (finite) {
    const std::vector<double>& tau = reaction_.after_step(
        couplings_.kvr(first_).end(), simulation.state(), simulation.kinematics(), h);
    if (watch_.mode() == DeviceWatchdog::Mode::live) rendered_ = force_->tick(state_, tau, h);
  }
  device_.render(rendered_);
  return rendered_;
}

ServoClock::ServoClock(double period)
    : period_(static_cast<std::int64_t>(std::llround(1e9 * period))) {}

void ServoClock::start() noexcept {
  deadline_ = nanoseconds_of(CLOCK_MONOTONIC) + period_;
}

ServoClock::Wake ServoClock::wait() noexcept {
  const timespec until{deadline_ / kSecond, deadline_ % kSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
  const std::int64_t late = nanoseconds_of(CLOCK_MONOTONIC) - deadline_;
  Wake wake{1e-9 * static_cast<double>(late), 0};
  deadline_ += period_;
  if (late > kMaxBehind * period_) {
    wake.slipped = static_cast<int>(late / period_);
    deadline_ += wake.slipped * period_;
  }
  return wake;
}

bool ServoClock::is_behind() const noexcept {
  return nanoseconds_of(CLOCK_MONOTONIC) > deadline_;
}

double monotonic_time() noexcept {
  return 1e-9 * static_cast<double>(nanoseconds_of(CLOCK_MONOTONIC));
}
double thread_cpu_time() noexcept {
  return 1e-9 * static_cast<double>(nanoseconds_of(CLOCK_THREAD_CPUTIME_ID));
}

std::string request_real_time() {
  std::string missing;
  const sched_param priority{sched_get_priority_min(SCHED_FIFO) + 20};
  if (const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority))
    missing = fmt::format("SCHED_FIFO ({}: give the user an rtprio in /etc/security/limits.conf)",
                          std::strerror(error));
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
    missing += fmt::format("{}memory lock ({}: raise memlock in /etc/security/limits.conf)",
                           missing.empty() ? "" : ", ", std::strerror(errno));
  return missing;
}

}  // namespace twinarm
