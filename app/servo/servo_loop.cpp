#include "app/servo/servo_loop.h"

#include <chrono>
#include <thread>

namespace twinarm {
namespace {

// Ticks between two drains: sixteen seconds at 1 kHz.
constexpr std::size_t kRing = 1 << 14;

class Servo {
 public:
  Servo(LiveRun& run, const ServoPlan& plan, const std::atomic<bool>& stop)
      : run_(run), plan_(plan), stop_(stop), ring_(kRing) {}

  void work() noexcept {
    if (plan_.ask_for_fifo) result_.refused = request_real_time();
    const double ticks = plan_.duration / run_.step();
    const auto each_second = static_cast<long>(std::lround(1 / run_.step()));
    ServoClock clock(run_.step());
    clock.start();
    double last = 0, first = 0;
    long done = 0, total = 0;
    while (static_cast<double>(done) < ticks - 1e-9 && !stop_.load(std::memory_order_relaxed)) {
      const bool is_empty = plan_.empty_loop && (total / each_second) % 2 == 1;
      TickFigures& figures = is_empty ? result_.empty : result_.run;
      wait(clock, figures, last, total % each_second == 0);
      if (total == 0) first = last;
      const double cpu = thread_cpu_time();
      if (!is_empty) {
        const TickResult tick = run_.tick();
        ++done;
        if (!ring_.push(tick)) ++result_.lost;
        result_.finite = tick.finite;
        if (!tick.finite) break;
      }
      figures.cpu.add(thread_cpu_time() - cpu);
      figures.wall.add(monotonic_time() - last);
      if (clock.is_behind()) ++figures.overruns;
      ++total;
    }
    result_.span = last - first;
    done_.store(true, std::memory_order_release);
  }
  bool is_done() const { return done_.load(std::memory_order_acquire); }
  SpscRing<TickResult>& ring() { return ring_; }
  ServoResult take() { return std::move(result_); }

 private:
  void wait(ServoClock& clock, TickFigures& figures, double& last, bool is_first_of_kind) noexcept {
    const ServoClock::Wake wake = clock.wait();
    const double now = monotonic_time();
    figures.late.add(wake.late);
    figures.slipped += wake.slipped;
    if (!is_first_of_kind) figures.interval.add(now - last);
    last = now;
  }

  LiveRun& run_;
  const ServoPlan& plan_;
  const std::atomic<bool>& stop_;
  SpscRing<TickResult> ring_;
  ServoResult result_;
  std::atomic<bool> done_{false};
};

// Without pacing, in this thread.
ServoResult run_unpaced(LiveRun& run, const ServoPlan& plan, const std::atomic<bool>& stop,
                        const std::function<void(SpscRing<TickResult>&)>& drain) {
  constexpr long kAtOnce = 100;
  SpscRing<TickResult> ring(kAtOnce);
  ServoResult result;
  const double ticks = plan.duration / run.step() - 1e-9;
  for (long done = 0; static_cast<double>(done) < ticks && !stop && result.finite; ++done) {
    if (done % kAtOnce == 0) drain(ring);
    const TickResult tick = run.tick();
    result.finite = tick.finite;
    ring.push(tick);
  }
  drain(ring);
  return result;
}

DeviceState first_state(InputDevice& device, ServoClock& clock, bool real_time, double h) {
  constexpr double kPatience = 5;  // [s]
  for (double waited = 0;; waited += h) {
    const DeviceState state = device.poll(0);
    if (state.alive) return state;
    if (waited > kPatience)
      throw InputError("--device", device.description() + " sends no data",
                       "switch it on, and end other programs that use it", "device.silent");
    if (real_time) clock.wait();
  }
}

constexpr double kMinStep = 1e-6, kMaxStep = 0.1;  // [s]

double step_of(const SceneModel& scene, const LiveOptions& options) {
  const bool is_option = options.step > 0;
  const double h = is_option ? options.step : scene.description.step;
  if (h >= kMinStep && h <= kMaxStep) return h;
  throw InputError(
      {{is_option ? "" : scene.description.file.string(), 0, is_option ? "--step" : "step",
        "is " + short_number_text(h) + " s; with an input device 1e-6 to 0.1 s are possible",
        "give 0.001", "hand.step"}});
}

// A tick takes one semi-implicit step of constant cost.
void check_steps(const SceneModel& scene, DiagnosticList& faults) {
  const std::string file = scene.description.file.string();
  const Integrator integrator = scene.description.integrator.value_or(Integrator::semi_implicit);
  if (integrator != Integrator::semi_implicit)
    faults.add({file, 0, "integrator",
                std::string("an input device requires semi-implicit, found ") +
                    integrator_name(integrator),
                "remove the key from the scene", "hand.integrator"});
  if (locates_events(scene))
    faults.add({file, 0, "contact",
                "located events are not possible in real time with an input device",
                "give contact = \"rigid\"", "hand.contact"});
}

// Couplings with target = "device", which must have the same driven joints.
std::vector<std::size_t> device_couplings(const SceneModel& scene, double h) {
  const std::string file = scene.description.file.string();
  DiagnosticList faults;
  check_steps(scene, faults);
  std::vector<std::size_t> driven;
  for (std::size_t c = 0; c < scene.couplings.size(); ++c) {
    const SceneCoupling& coupling = scene.couplings[c];
    if (coupling.target.kind != CouplingTarget::Kind::device) continue;
    driven.push_back(c);
    if (!coupling.is_first_component()) continue;
    const std::string where = "coupling '" + coupling.coupling + "'";
    if (coupling.driven.turned.empty())
      faults.add({file, coupling.line, where, "its robot has no joint of one degree of freedom",
                  "name a robot with revolute or prismatic joints", "scene.nothing-to-drive"});
    if (coupling.driven.turned != scene.couplings[driven.front()].driven.turned)
      faults.add({file, coupling.line, where, "the device drives other joints of another coupling",
                  "one device moves one robot: give it another target", "hand.two-robots"});
    if (coupling.delay > kMaxDelay - h)
      faults.add({file, coupling.line, where + ", delay",
                  "with target = \"device\" at most 2 s minus a step are possible",
                  "give a shorter delay", "hand.delay"});
  }
  if (driven.empty())
    faults.add({file, 0, "coupling", "no coupling has target = \"device\"",
                "give target = \"device\" to the couplings that the device drives",
                "hand.no-device"});
  faults.check();
  return driven;
}

}  // namespace

ServoResult run_servo(LiveRun& run, const ServoPlan& plan, const std::atomic<bool>& stop,
                      const std::function<void(SpscRing<TickResult>&)>& drain) {
  if (!plan.real_time) return run_unpaced(run, plan, stop, drain);
  Servo servo(run, plan, stop);
  std::thread thread([&] { servo.work(); });
  while (!servo.is_done()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    drain(servo.ring());
  }
  thread.join();
  drain(servo.ring());
  return servo.take();
}

LiveRun::LiveRun(const SceneModel& scene, InputDevice& device, const LiveOptions& options)
    : h_(step_of(scene, options)),
      driven_(device_couplings(scene, h_)),
      hand_(std::make_unique<DeviceMotion>(stored_steps(kMaxDelay, h_) + 2)),
      couplings_(std::make_unique<SceneCouplings>(scene, h_, hand_.get())),
      simulation_(scene.model, scene.start) {
  loop_ = std::make_unique<HapticLoop>(scene, *couplings_, driven_, device, options);
  for (std::size_t c = 0; c < couplings_->size(); ++c)
    if (ForceSource* source = couplings_->source(c)) simulation_.add(*source);
  for (const SceneMotion& motion : scene.motions) simulation_.prescribe(motion.body, motion.law);
  contacts_.emplace(scene, simulation_);
  loop_->begin(loop_->target().q, 0);
}

TickResult LiveRun::tick() noexcept {
  TickResult result;
  const double t = time();
  const MappedTarget& target = loop_->before_step(simulation_.state(), t, h_);
  hand_->set(target, t, h_);
  result.motion = hand_->newest();
  const std::vector<double>& q_D = loop_->q_D();
  for (std::size_t j = 0; j < std::min(result.error.size(), q_D.size()); ++j)
    result.error[j] = target.q[j] - q_D[j];
  result.mode = loop_->watch().mode();
  if (!stopped_) stopped_ = !simulation_.step(h_).finite;
  result.finite = !stopped_;
  result.motor_torques = loop_->after_step(simulation_, h_, result.finite).torque;
  return result;
}

std::unique_ptr<DeviceMotion> record_operator(InputDevice& device, double duration, bool real_time,
                                              const std::function<void(double)>& tick) {
  const double h = 1 / device.parameters().rate;
  const auto steps = stored_steps(duration - 1e-9 * h, h);
  auto hand = std::make_unique<DeviceMotion>(steps);
  ServoClock clock(h);
  clock.start();
  DeviceState last = first_state(device, clock, real_time, h);
  for (std::size_t n = 0; n < steps; ++n) {
    const double t = static_cast<double>(n) * h;
    if (real_time) clock.wait();
    DeviceState now = device.poll(t);
    if (!now.alive) now = last;
    DeviceStep step{t, h, {}};
    step.sample.theta = now.theta;
    for (std::size_t j = 0; j < now.theta.size(); ++j)
      step.sample.theta_dot[j] = (now.theta[j] - last.theta[j]) / h;
    step.sample.button = now.buttons[0];
    hand->set(step);
    device.render({});
    last = now;
    tick(t + h);
  }
  return hand;
}

}  // namespace twinarm
