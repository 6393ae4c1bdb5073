// Variants: each equals the run alone, and their frames are stored together.
#include "app/lab/run/variants.h"

#include <numbers>

#include "app/film/filmed_run.h"
#include "app/lab/stream/lab_view.h"
#include "tests/app/lab/run/helpers.h"
#include "tests/app/lab/stream/frame_reader.h"

namespace twinarm {
namespace {

LabScene swinging() {
  SimulateOptions options;
  options.robot.model = fs::path(TWINARM_SOURCE_DIR) / "assets/scenes/six_integrators.toml";
  return LabScene(options);
}

// Held by an explicit spring, which gains energy from 3.96e6 N m/rad on: slowly at 4e6.
const std::string kRod = test_data("app/lab/stream/rod.toml");
const VariantSet kOneDiverges{"coupling.stiffness", {"2000", "4e6", "500"}, {}};

// A run with its variants and history: a frame each 4 steps.
struct SideBySide {
  SideBySide(const LabScene& of, VariantSet variants, std::vector<Change> with = {})
      : scene(of), set(std::move(variants)), changes(std::move(with)) {
    begin(nullptr);
  }
  std::vector<Change> changes_of(std::size_t variant) const {
    std::vector<Change> own = changes;
    put(own, set.change(variant));
    return own;
  }
  void begin(const LabFrame* from) {
    std::vector<std::unique_ptr<LabScene::Plan>> plans;
    for (std::size_t variant = 1; variant < set.values.size(); ++variant)
      plans.push_back(scene.plan(changes_of(variant)));
    run = std::make_unique<LabRun>(scene.plan(changes_of(0)), hand, from);
    others = LabVariants(set, std::move(plans), from, names);
    if (from) run->carry_over_energy(*from, names);
    history.begin_segment(changes_of(0));
    history.add(frame());
  }
  LabFrame frame() {
    LabFrame made = run->frame(names);
    others.add_to(made, names);
    return made;
  }
  void step(long steps, const LabHistory* again = nullptr) {
    for (long n = 0; n < steps; ++n) {
      const LabInput* input = again ? again->input(run->view().step() + 1) : nullptr;
      const LabInput none;
      REQUIRE(run->step(input ? input : again ? &none : nullptr));
      others.follow(*run);
      history.add(run->input());
      if (run->view().step() % 4 == 0) history.add(frame());
    }
  }
  const LabFrame& variant(std::size_t n) const { return *history.newest()->variants[n - 1].frame; }

  const LabScene& scene;
  VariantSet set;
  std::vector<Change> changes;
  OperatorInput hand;
  LabNames names;
  LabHistory history;
  std::unique_ptr<LabRun> run;
  LabVariants others;
};

// Time and checkpoint.
void check_same_state(const LabFrame& one, const LabFrame& other) {
  CHECK(one.recorded.t == other.recorded.t);
  CHECK(one.recorded.step == other.recorded.step);
  CHECK(one.recorded.memory == other.recorded.memory);
}
// And the energy balance.
void check_same(const LabFrame& one, const LabFrame& other) {
  check_same_state(one, other);
  CHECK(one.recorded.works == other.recorded.works);
}

// Equal to rounding: a branch begins its sums at its own time.
void check_balance(const LabFrame& one, const LabFrame& other) {
  REQUIRE(one.recorded.works.size() == other.recorded.works.size());
  for (std::size_t k = 0; k < one.recorded.works.size(); ++k)
    CHECK(one.recorded.works[k] == doctest::Approx(other.recorded.works[k]).epsilon(1e-9));
}

// The scene with one variant's changes, alone, up to that step.
LabFrame alone(SideBySide& s, std::size_t variant, long steps) {
  OperatorInput unused;
  LabRun run(s.scene.plan(s.changes_of(variant)), unused);
  while (run.view().step() < steps) REQUIRE(run.step());
  return run.frame(s.names);
}

const VariantSet kSix{
    "integrator", {"semi-implicit", "euler", "implicit-euler", "verlet", "rk4", "midpoint"}, {}};

}  // namespace

TEST_CASE("variants: each repeats bit for bit the scene alone with its value") {
  const LabScene scene = swinging();
  SideBySide s(scene, kSix);
  s.step(640);
  for (std::size_t variant = 1; variant < 6; ++variant) {
    CAPTURE(kSix.values[variant]);
    check_same(s.variant(variant), alone(s, variant, 640));
    CHECK(s.variant(variant).recorded.memory != s.history.newest()->recorded.memory);
  }
  check_same(*s.history.newest(), alone(s, 0, 640));
}

TEST_CASE("variants: with other steps each follows the run's clock within half its step") {
  const LabScene scene = swinging();
  SideBySide s(scene, {"step", {"0.02", "0.0007", "0.05"}, {}});
  for (int n = 0; n < 20; ++n) {
    s.step(16);
    CHECK(std::abs(s.variant(1).recorded.t - s.run->view().time()) <= 0.5 * 0.0007 + 1e-12);
    CHECK(std::abs(s.variant(2).recorded.t - s.run->view().time()) <= 0.5 * 0.05 + 1e-12);
  }
  for (std::size_t variant = 1; variant < 3; ++variant)
    check_same(s.variant(variant), alone(s, variant, s.variant(variant).recorded.step));
}

// A target moving from 0.7 rad at maximum speed: in a step from t it is at 0.7 + kMaxJointSpeed (t
// + h), h of the run, extrapolated in variants whose last step begins later.
TEST_CASE("variants: with shorter steps a moving target is extrapolated") {
  const LabScene scene = lab_scene(kRod);
  constexpr double h = 0.004, begin = 0.7;
  SideBySide s(scene, {"step", {"0.004", "0.002", "0.001"}, {}});
  s.hand.choose(OperatorInput::Source::joints);
  s.hand.joint(0, 100);
  s.step(16);
  for (std::size_t variant = 0; variant < 3; ++variant) {
    const LabFrame& own = variant == 0 ? *s.history.newest() : s.variant(variant);
    const double last_began = 16 * h - h / std::pow(2, variant);
    CHECK(own.hand->q_K[0] ==
          doctest::Approx(begin + OperatorInput::kMaxJointSpeed * (last_began + h)).epsilon(1e-12));
  }
}

// Two variants of the same value are the same run for any input.
TEST_CASE("variants: operator and mouse input act on all as on the first") {
  const LabScene scene = lab_scene(arm_with("device"));
  SideBySide s(scene, {"coupling.stiffness", {"700", "700", "4000"}, {}});
  s.hand.choose(OperatorInput::Source::drag);
  const Vector3 tip = s.run->prepared().input.couplings->kvr(0).start().k.position(
      s.run->input_override().tip()->first, s.run->input_override().tip()->second);
  for (int n = 0; n < 40; ++n) {
    s.hand.tip(tip + Vector3(-0.1 * std::sin(0.1 * n), 0.2 * std::sin(0.2 * n), 0));
    if (n == 20)
      REQUIRE(s.run->drag(s.run->input_override().driven().back(), Vector3::Zero(), tip));
    if (n == 30) s.run->release_mouse();
    s.step(16);
    check_same(s.variant(1), *s.history.newest());
    CHECK(s.variant(1).hand->q_K == s.history.newest()->hand->q_K);
    CHECK(s.variant(2).hand->q_K == s.history.newest()->hand->q_K);
  }
  CHECK(s.variant(2).recorded.memory != s.variant(1).recorded.memory);
}

TEST_CASE("variants: a diverged one stays at its last frame, and the others are not affected") {
  const LabScene scene = lab_scene(kRod);
  SideBySide s(scene, kOneDiverges);
  CHECK(s.others.take_warnings().empty());
  s.step(640);
  const std::vector<std::string> warnings = s.others.take_warnings();
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("variant 4e6 stopped at") == 0);
  CHECK(s.others.take_warnings().empty());
  const VariantFrame stopped = s.history.newest()->variants[0];
  CHECK(stopped.stopped);
  CHECK(stopped.frame->recorded.t < 0.5);
  CHECK(std::isfinite(stopped.frame->recorded.values[0]));
  CHECK_FALSE(s.history.newest()->variants[1].stopped);
  check_same(s.variant(2), alone(s, 2, 640));
  check_same(*s.history.newest(), alone(s, 0, 640));
  s.step(160);
  CHECK(s.history.newest()->variants[0].frame == stopped.frame);  // no copies
}

TEST_CASE("variants: a branch repeats all of them, the diverged one too") {
  const LabScene scene = lab_scene(kRod);
  SideBySide s(scene, kOneDiverges);
  s.hand.choose(OperatorInput::Source::joints);
  for (int n = 0; n < 40; ++n) {
    s.hand.joint(0, 0.3 * std::sin(0.2 * n));
    s.step(16);
  }
  REQUIRE(s.history.newest()->variants[0].stopped);
  std::size_t first_stopped = 0;
  while (!s.history.frame(first_stopped)->variants[0].stopped) ++first_stopped;
  REQUIRE(first_stopped > 1);
  for (const std::size_t from : {first_stopped - 1, first_stopped + 5}) {
    const LabHistory left = s.history.cut(from);
    s.begin(left.frame(0).get());
    CHECK(s.history.size() == from + 1);
    s.step(left.newest()->recorded.step - left.frame(0)->recorded.step, &left);
    REQUIRE(s.history.size() == from + left.size());
    for (std::size_t n = 0; n < left.size(); ++n) {
      const LabFrame &was = *left.frame(n), &is = *s.history.frame(from + n);
      check_same_state(is, was);
      check_balance(is, was);
      for (std::size_t variant = 0; variant < 2; ++variant) {
        CHECK(is.variants[variant].stopped == was.variants[variant].stopped);
        check_same_state(*is.variants[variant].frame, *was.variants[variant].frame);
        check_balance(*is.variants[variant].frame, *was.variants[variant].frame);
      }
    }
  }
}

TEST_CASE("variants: their frames count to the history's limit of bytes") {
  const LabScene scene = swinging();
  SideBySide s(scene, kSix), single(scene, {"integrator", {"semi-implicit"}, {}});
  s.history = LabHistory(100000);
  single.history = LabHistory(100000);
  for (SideBySide* one : {&s, &single}) {
    one->history.begin_segment({});
    one->step(3000);
  }
  std::size_t memory = 0;
  for (std::size_t n = 0; n < s.history.size(); ++n) {
    memory += s.history.frame(n)->recorded.memory.size();
    for (const VariantFrame& variant : s.history.frame(n)->variants)
      memory += variant.frame->recorded.memory.size() + sizeof(LabFrame);
  }
  CHECK(memory < s.history.bytes());
  CHECK(s.history.bytes() <= 100000);
  CHECK(s.history.bytes() > 80000);
  CHECK(single.history.size() > 4 * s.history.size());
}

TEST_CASE("variants: shown at their offsets, with joint positions and energies by name") {
  const LabScene scene = swinging();
  SideBySide s(scene, {"integrator", {"semi-implicit", "euler", "rk4"}, Vector3(0, 0.5, 0)});
  s.step(160);
  const auto shared = [&](std::size_t variant) {
    const std::shared_ptr<const LabScene::Plan> plan = scene.plan(s.changes_of(variant));
    return std::shared_ptr<const SimulatePlan>(plan, &plan->prepared);
  };
  LabView view(1, shared(0), scene.header(s.changes_of(0), {}), {},
               {s.set, {shared(1), shared(2)}});
  view.name_rows(s.names.rows);
  const auto channels = texts_in(view.scene_message(), "channels", "name");
  const auto value = [&](const ReadFrame& of, const std::string& name) {
    const auto found = std::find(channels.begin(), channels.end(), name);
    REQUIRE_MESSAGE(found != channels.end(), name);
    return of.channels[static_cast<std::size_t>(found - channels.begin())];
  };
  LabFrame frame = s.frame();
  const ReadFrame read(view.frame(frame, nullptr, {}, {}));
  REQUIRE(read.instances() == 9);  // hook, rod and ball of each
  // 1 kg at 1 m below a hinge at 1.2 m; 2/5 m r^2 about its own middle; energies about the hinge.
  const double start = -9.81 * std::cos(std::numbers::pi / 3), hinge = 9.81 * 1.2;
  for (std::size_t variant = 0; variant < 3; ++variant) {
    CAPTURE(variant);
    const std::string& name = s.set.values[variant];
    const LabFrame& own = variant == 0 ? frame : *frame.variants[variant - 1].frame;
    const State<double> x = instant_of(own.recorded, scene.plan()->prepared.input.robot.model).x;
    const double energy = 0.5 * 1.00144 * x.qd[0] * x.qd[0] - 9.81 * std::cos(x.q[0]);
    CHECK(value(read, "variant/q/hinge/" + name) == x.q[0]);
    CHECK(value(read, "variant/total_energy/" + name) ==
          doctest::Approx(hinge + energy).epsilon(1e-9));
    CHECK(value(read, "variant/numerical/" + name) ==
          doctest::Approx(energy - start).epsilon(1e-9).scale(1));
    const std::size_t ball = 3 * variant + 2;
    CHECK(std::abs(read.position[3 * ball]) == doctest::Approx(std::abs(std::sin(x.q[0]))));
    CHECK(read.position[3 * ball + 1] == doctest::Approx(0.5 * static_cast<double>(variant)));
    CHECK(read.position[3 * ball + 2] == doctest::Approx(1.2 - std::cos(x.q[0])));
    CHECK((read.body[ball] == 65535) == (variant > 0));  // only the first can be picked
  }
  CHECK(read.text ==
        "semi-implicit"
        "euler"
        "rk4");
  frame.variants[0].stopped = true;
  const ReadFrame after(view.frame(frame, nullptr, {}, {}));
  CHECK(after.labels_of(0) ==
        std::vector<std::string>{"semi-implicit", "euler: stopped at 3.2 s", "rk4"});
  CHECK(after.position == read.position);
  CHECK(std::isnan(value(after, "variant/total_energy/euler")));
}

TEST_CASE("variants: invalid sets are refused with a remedy") {
  CHECK(parse_variants("integrator=semi-implicit,rk4").values ==
        std::vector<std::string>{"semi-implicit", "rk4"});
  CHECK(parse_variants("body.position=[0,0,1],[0,0,2]").values ==
        std::vector<std::string>{"[0,0,1]", "[0,0,2]"});
  for (const char* text : {"", "integrator", "integrator=rk4", "=a,b", "step=0.1,", "step=1,2,1",
                           "step=1,2,3,4,5,6,7,8"}) {
    CAPTURE(text);
    const std::vector<Diagnostic> faults = faults_of([&] { parse_variants(text); });
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].where == std::string("--variants ") + text);
    CHECK_FALSE(faults[0].fix.empty());
  }
}

}  // namespace twinarm
