// A run of the lab: bits of `simulate`, changes, operator input, mouse spring.
#include "app/record/unpack.h"
#include "tests/app/lab/run/helpers.h"

namespace twinarm {

namespace {

// A run with a frame every `period` seconds.
std::filesystem::path recorded(const TemporaryFolder& folder, const SimulateOptions& options,
                               double period) {
  const SimulatePlan plan = prepare_simulation(options);
  const std::filesystem::path file = folder.path() / "run.twinrec";
  RunRecorder recorder(file, header_of(options, plan, {}), plan, period);
  RunWatch watch;
  watch.look = [&](SteppedRun& run) { recorder.look(run); };
  run_plan(plan.input, plan.run, watch);
  recorder.finish("done");
  return file;
}

}  // namespace

TEST_CASE("lab run: steps equal those of `simulate` bit for bit, after its files were removed") {
  for (const char* target : {"paper", "device"}) {
    const TemporaryFolder folder;
    const SimulateOptions options = options_of(folder, arm_with(target));
    const SimulatePlan plan = prepare_simulation(options);
    std::vector<std::string> memories;
    RunWatch watch;
    watch.look = [&](SteppedRun& run) {
      if (run.step() % 100 == 0) memories.push_back(run.memory());
    };
    run_plan(plan.input, plan.run, watch);
    REQUIRE(memories.size() == 11);
    const LabScene scene = lab_scene(arm_with(target));
    OperatorInput hand;
    LabRun run(scene.plan(), hand);
    for (long n = 0; n < 1500; ++n) {  // beyond the end of `simulate`
      if (n % 100 == 0 && n <= 1000)
        CHECK(run.view().memory() == memories[static_cast<std::size_t>(n / 100)]);
      REQUIRE(run.step());
    }
    CHECK(run.view().time() == doctest::Approx(1.5).epsilon(1e-12));
  }
}

TEST_CASE("recorded instant: its files can be read after the recording is closed") {
  const TemporaryFolder folder;
  const SimulateOptions options = options_of(folder, arm_with("paper"));
  const std::filesystem::path file = recorded(folder, options, 0.5);
  const RecordedInstant instant = open_instant(file, {});
  const SimulateOptions again = instant.files->options();
  CHECK(again.robot.model.filename() == options.robot.model.filename());
  CHECK(prepare_simulation(again).input.scene->couplings.size() == 3);
}

TEST_CASE("lab run: a stiffness changed at a frame equals the branch of a recording from there") {
  const TemporaryFolder folder;
  SimulateOptions options = options_of(folder, arm_with("paper"));
  const std::filesystem::path file = recorded(folder, options, 0.05);
  const Recording recording(file);
  const std::vector<Change> changes{{"coupling.one.stiffness", "900"}};
  const Replay branch = replay(recording, 8, changes);

  LabFrame from;
  from.recorded.memory = memory_at(recording, 8, UnpackedRun(recording.header()));
  const LabScene scene{recording.header()};
  OperatorInput hand;
  LabRun run(scene.plan(changes), hand, &from);
  CHECK(run.restart_reason().empty());
  LabNames names;
  CHECK(branch.frames.size() == recording.size() - 8);
  for (const RecordedFrame& frame : branch.frames) {
    while (run.view().step() < frame.step) REQUIRE(run.step());
    RecordedFrame now = run.frame(names).recorded;
    take_state_from_memory(now);
    CHECK(now.q == frame.q);
    CHECK(now.qd == frame.qd);
  }
  CHECK(branch.frames.back().q != recording.frame(recording.size() - 1).q);
}

TEST_CASE(
    "recording: frames read in any order, and memory between keyframes, are those of the run") {
  const TemporaryFolder folder;
  SimulateOptions options = options_of(folder, arm_with("paper"));
  options.duration = 0.15;
  const Recording recording(recorded(folder, options, 0));
  REQUIRE(recording.size() == 151);
  const SimulatePlan plan = prepare_simulation(options);
  std::vector<RecordedFrame> frames;
  RunWatch watch;
  watch.look = [&](SteppedRun& run) {
    frames.push_back(frame_of(run, plan));
    take_state_from_memory(frames.back());
  };
  run_plan(plan.input, plan.run, watch);
  const UnpackedRun files(recording.header());
  std::size_t equal = 0, keyframes = 0;
  for (std::size_t i = 0; i < 151; ++i) {
    const std::size_t n = 32 * i % 151;
    RecordedFrame frame = recording.frame(n);
    CHECK((frame.memory.empty() || frame.memory == frames[n].memory));
    if (n % 10 == 0) CHECK(memory_at(recording, n, files) == frames[n].memory);
    keyframes += frame.memory.empty() ? 0 : 1;
    StateArchive read, ran;
    visit_motion(read, frame);
    visit_motion(ran, frames[n]);
    equal += read.bytes() == ran.bytes() ? 1 : 0;
  }
  CHECK(equal == 151);
  CHECK(keyframes == 3);
}

TEST_CASE("lab run: the target robot never jumps and reaches its goal, for every input source") {
  Session s(arm_with("paper"));
  std::vector<double> before;
  double farthest = 0;
  const auto run = [&](long steps, const std::function<void(long)>& each) {
    for (long n = 0; n < steps; ++n) {
      each(n);
      s.step(1);
      const std::vector<double> now = kvr_of(*s.run);
      for (std::size_t j = 0; j < before.size(); ++j)
        farthest = std::max(farthest, std::abs(now[j] - before[j]));
      before = now;
    }
  };
  const auto nothing = [](long) {};
  run(500, nothing);
  CHECK(!s.run->input_override().is_active());
  s.hand.choose(OperatorInput::Source::drag);
  const Vector3 goal(0.35, 0.4, 0.4);
  run(3000, [&](long) { s.hand.tip(goal); });
  const auto tip = *s.run->input_override().tip();
  const auto tip_now = [&] {
    return s.run->prepared().input.couplings->kvr(0).end().k.position(tip.first, tip.second);
  };
  // Static deflection of the arm model under friction and force, scaled.
  const Vector3 force = s.run->frame(s.names).hand->force_W;
  const double reach = s.hand.mapping().scale * (0.26 + force.norm()) / ArmImpedance{}.stiffness;
  CHECK((tip_now() - goal).head<2>().norm() < reach);
  CHECK(force.norm() <= OmniParameters{}.peak_force * 1.01);
  s.hand.release();
  const Vector3 released = tip_now();
  run(300, nothing);
  CHECK((tip_now() - released).norm() < 0.01);
  s.hand.choose(OperatorInput::Source::joints);
  s.hand.joint(0, -0.6);
  s.hand.joint(2, 0.3);
  run(2000, nothing);
  CHECK(s.run->input_override().q()[0] == doctest::Approx(-0.6));
  CHECK(s.run->input_override().q()[2] == doctest::Approx(0.3));
  s.hand.choose(OperatorInput::Source::device, "virtual:synthetic:3");
  run(1000, nothing);
  CHECK(s.run->input_override().is_active());
  s.hand.choose(OperatorInput::Source::scene);
  run(3000, nothing);
  CHECK(!s.run->input_override().is_active());
  CHECK(farthest <= 20 * 0.001 * (1 + 1e-9));  // limit of the mapping
  CHECK(farthest > 1e-4);
}

TEST_CASE("lab run: a branch with another step repeats the operator's motion, and goes on live") {
  Session s(arm_with("paper"));
  s.hand.choose(OperatorInput::Source::drag);
  s.step(16);
  for (long n = 0; n < 800; ++n) {
    s.hand.tip({0.35, 0.4, 0.4});
    s.step(1);
  }
  s.hand.release();
  const std::vector<double> last = kvr_of(*s.run);
  const LabFrame start = *s.history.frame(1);
  LabRun branch(s.scene.plan({{"step", "2e-4"}}), s.hand, &start);
  std::vector<double> before = kvr_of(branch);
  double farthest = 0;
  while (branch.view().time() < s.run->view().time() + 0.1) {
    const double t = branch.view().time();
    const LabInput* known = s.history.input_at(t);
    REQUIRE((known != nullptr) == (t < s.run->view().time() - 1e-9));
    REQUIRE(branch.step(known));
    const std::vector<double> now = kvr_of(branch);
    for (std::size_t j = 0; j < now.size(); ++j)
      farthest = std::max(farthest, std::abs(now[j] - before[j]));
    before = now;
    if (std::abs(t - (s.run->view().time() - 0.001)) > 1e-9) continue;
    for (std::size_t j = 0; j < last.size(); ++j) CHECK(now[j] == doctest::Approx(last[j]));
  }
  CHECK(farthest <= 20 * 2e-4 * (1 + 1e-6));  // limit of the mapping
}

TEST_CASE("lab run: a frame between the choice of a source and the next step is valid") {
  Session s(arm_with("device"));
  s.hand.choose(OperatorInput::Source::drag);
  s.step(20);
  REQUIRE(s.run->frame(s.names).hand->active);
  const std::vector<double> q = s.run->input_override().q();
  s.hand.choose(OperatorInput::Source::joints);  // without a device
  CHECK(s.run->frame(s.names).hand->q_K == q);
  s.hand.choose(OperatorInput::Source::device, "virtual:step");
  const OperatorFrame frame = *s.run->frame(s.names).hand;
  CHECK(frame.q_K == q);
  CHECK(frame.torque == std::array<double, 3>{});
}

TEST_CASE("lab run: the gripper keeps its state when keys are released or the device changes") {
  Session s(arm_with("device"));
  s.hand.choose(OperatorInput::Source::drag);
  s.hand.button(0, true);
  s.hand.axes({1, 0, 0, 0, 0, 0});
  s.step(20);
  CHECK(s.run->frame(s.names).hand->gripper_closed);
  s.hand.release();
  s.step(20);
  CHECK(s.run->frame(s.names).hand->gripper_closed);
  s.hand.choose(OperatorInput::Source::drag);
  s.step(20);
  CHECK(s.run->frame(s.names).hand->gripper_closed);
  s.hand.button(0, false);
  s.step(20);
  CHECK_FALSE(s.run->frame(s.names).hand->gripper_closed);
}

TEST_CASE("lab run: a body on the mouse spring is a damped oscillator; both balances close") {
  Session s(kFreeBox);
  const Vector3 goal(0.1, -0.05, 1.2);
  s.hand.set_stamp(7);
  REQUIRE(s.run->drag(1, Vector3::Zero(), goal));
  const double m = 2, h = 0.001, k = m * MouseSpring::kOmega * MouseSpring::kOmega,
               b = 2 * m * MouseSpring::kOmega;
  Vector3 x(0, 0, 1), v = Vector3::Zero();
  double worst = 0, closed_form = 0;
  for (int n = 1; n <= 400; ++n) {
    s.step(1);
    v = (m * v + h * k * (goal - x)) / (m + h * b + h * h * k);  // backward Euler
    x += h * v;
    const Vector3 p = s.run->view().simulation().kinematics().X_WL[1].p;
    worst = std::max(worst, (p - x).norm());
    const double wt = MouseSpring::kOmega * n * h;
    const Vector3 exact = goal + (1 + wt) * std::exp(-wt) * (Vector3(0, 0, 1) - goal);
    closed_form = std::max(closed_form, (p - exact).norm());
  }
  CHECK(worst < 1e-12);
  CHECK(closed_form < 0.02 * 0.23);  // of the way; an error of order w h = 0.015
  CHECK(closed_form > 1e-5);
  const SteppedRun& view = s.run->view();
  const double energy =
      kinetic_energy(view.simulation().mechanism().model(), view.simulation().state());
  const auto rows = s.run->view().energy_balance();
  CHECK(work_of(rows, "mouse") == doctest::Approx(energy).epsilon(1e-9));
  CHECK(std::abs(work_of(rows, "numerical")) < 1e-9 * energy);
  const auto momenta = s.run->view().momentum();
  CHECK((momentum_of(momenta, "mouse").linear - m * v).norm() < 1e-9 * (m * v).norm());
  CHECK(momentum_of(momenta, "numerical").linear.norm() < 1e-9 * (m * v).norm());
  CHECK(momentum_of(momenta, "numerical").angular.norm() < 1e-9 * (m * v).norm());
  CHECK(s.history.newest()->input_stamp == 7);
}

TEST_CASE(
    "lab run: a mouse spring on a link loads the base through its joints; its force is limited") {
  Session s(arm_with("device"));
  const Vector3 goal(0.3, 0.6, 0.5);
  REQUIRE(s.run->drag(s.run->input_override().driven()[1], Vector3(0.35, 0, 0.1), goal));
  s.step(2000);
  const auto momenta = s.run->view().momentum();
  CHECK(momentum_of(momenta, "mouse").linear.norm() > 1);
  // The residual is small.
  CHECK(momentum_of(momenta, "numerical").linear.norm() <
        1e-3 * momentum_of(momenta, "mouse").linear.norm());
  CHECK(!s.run->drag(0, Vector3::Zero(), goal));  // the world does not move
  CHECK(!s.run->drag(99, Vector3::Zero(), goal));
}

TEST_CASE("lab run: invalid changes are refused with all faults, and the run continues") {
  Session s(arm_with("paper"));
  s.step(10);
  const LabFrame frame = s.run->frame(s.names);
  try {
    const LabRun other(
        s.scene.plan({{"step", "-1"}, {"coupling.one.stiffnes", "3"}, {"integrator", "rk5"}}),
        s.hand, &frame);
    FAIL("it was taken");
  } catch (const InputError& error) {
    CHECK(error.faults().size() >= 2);
  }
  s.step(10);
}

TEST_CASE("lab run: an unstable spring stops the run, and is named with a stable value") {
  Session s(arm_with("paper"));
  s.step(100);
  const auto rows = s.run->view().energy_balance();
  s.change({{"coupling.one.discretization", "explicit"}, {"coupling.one.stiffness", "3e7"}});
  long n = 0;
  while (s.run->step() && n < 2000) ++n;
  const PostMortem* found = s.run->post_mortem(rows);
  REQUIRE(found);
  REQUIRE(!found->violations.empty());
  CHECK(found->violations.front().name == "coupling 'one'");
  CHECK(found->violations.front().step > found->violations.front().max_step);
  CHECK(!found->violations.front().fix.empty());
  CHECK(found->words.size() >= 2);
  CHECK(!found->row.empty());
  CHECK(!s.run->step());
}

}  // namespace twinarm
