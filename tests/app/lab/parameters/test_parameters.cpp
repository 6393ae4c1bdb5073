// Parameters and their limits against runs.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "tests/app/lab/parameters/parameter_scenes.h"
#include "tests/collision/import/robot/helpers.h"

using namespace twinarm;

TEST_CASE("parameters: all set to their shown values change no bit of the run") {
  for (const auto& file : offered_scenes()) {
    INFO(file.filename().string());
    const SimulatePlan plan = planned(file, {}, 20);
    const std::string memory = ran(plan, 20).memory;
    REQUIRE(!memory.empty());
    std::vector<std::string> changes;
    for (const LabParameter& parameter : parameters_of(plan))
      if (const std::string value = parameter.value(); !value.empty())
        changes.push_back(parameter.path + "=" + value);
    CHECK(changes.size() >= 3);
    CHECK(ran(planned(file, changes, 20), 20).memory == memory);
  }
}

TEST_CASE("parameters: each end of a range and each choice gives a scene that runs") {
  const auto folder = read_gallery().front().file.parent_path();
  for (const char* name : {"study.toml", "study_e3.toml", "study_e4.toml", "tracking_map.toml",
                           "pendulum.toml", "incline.toml", "bouncing_ball.toml"})
    for (const LabParameter& parameter : parameters_of(planned(folder / name, {}))) {
      std::vector<std::string> values = parameter.choices;
      if (parameter.form != "choice") {
        CHECK(parameter.low < parameter.high);
        values = {fmt::format("{}", parameter.low), fmt::format("{}", parameter.high)};
      }
      for (const std::string& value : values) {
        INFO(std::string(name), ": ", parameter.path, "=", value);
        SimulatePlan plan = planned(folder / name, {parameter.path + "=" + value}, 2);
        plan.run.energy_bound = HUGE_VAL;
        CHECK(ran(plan, 2).end > 0);
      }
    }
}

TEST_CASE("parameters: each has a label, a group, a description, and its value among its choices") {
  for (const auto& file : offered_scenes())
    for (const LabParameter& parameter : parameters_of(planned(file, {}))) {
      INFO(file.filename().string(), ": ", parameter.path);
      CHECK(!parameter.label.empty());
      CHECK(!parameter.group.empty());
      CHECK(parameter.description.size() > 20);
      if (parameter.form == "choice" && !parameter.text.empty())
        CHECK(std::count(parameter.choices.begin(), parameter.choices.end(), parameter.text) == 1);
      if (parameter.form == "log") CHECK(parameter.low > 0);
    }
}

namespace {

std::vector<LabParameter> predicted(const std::string& text,
                                    const std::vector<std::string>& changes = {}) {
  SimulatePlan plan = planned(temporary_scene("predicted", text), changes);
  std::vector<LabParameter> parameters = parameters_of(plan);
  predict_limits(plan, State<double>(plan.input.robot.state.x), parameters);
  return parameters;
}

struct LimitCase {
  const char *name, *top, *spring, *path;
};

// Whether a disturbance does not grow within 3000 steps.
bool is_stable(const std::string& text, const std::string& change) {
  const long steps = 3000;
  SimulatePlan plan = planned(temporary_scene("limit", text), {change}, steps);
  plan.run.energy_bound = 1;
  const ShortRun run = ran(plan, steps);
  return !run.stopped && run.late < 20 * run.early;
}

const char* const kLinear = "type = \"linear\"\nstiffness = 2e4\ndamping = 40\n";

}  // namespace

TEST_CASE(
    "parameters: a run is stable 10 percent within a predicted limit, and unstable 10 percent "
    "beyond") {
  const std::string linear = std::string(kLinear) + "discretization = \"explicit\"";
  const std::string half = std::string(kLinear) + "discretization = \"semi-implicit\"";
  const std::string held = "type = \"linear\"\nstiffness = 4000\ndamping = 40\nrate = 250";
  const std::string printed = "type = \"published-linear\"\nstiffness = 2e4\ndamping = 40";
  const std::string turning =
      "type = \"torsional\"\nstiffness = 500\ndamping = 2\ndiscretization = \"explicit\"";
  const auto pointless = [](std::string text) {  // torsional couplings have no point
    for (std::size_t at; (at = text.find("point = ")) != std::string::npos;)
      text.erase(at, text.find('\n', at) - at);
    return text;
  };
  const LimitCase cases[] = {
      {"semi-implicit", "", linear.c_str(), "coupling.stiffness"},
      {"semi-implicit", "", linear.c_str(), "coupling.damping"},
      {"semi-implicit", "", linear.c_str(), "coupling[1].stiffness"},
      {"semi-implicit", "", linear.c_str(), "step"},
      {"euler", "integrator = \"euler\"", linear.c_str(), "coupling.stiffness"},
      {"euler", "integrator = \"euler\"", linear.c_str(), "step"},
      {"rk4", "integrator = \"rk4\"", linear.c_str(), "coupling.stiffness"},
      {"damper implicit", "", half.c_str(), "coupling.stiffness"},
      {"held", "", held.c_str(), "coupling.stiffness"},
      {"held", "", held.c_str(), "coupling[0].damping"},
      {"printed", "", printed.c_str(), "coupling.stiffness"},
      {"torsional", "", turning.c_str(), "coupling[0].stiffness"},
      {"torsional", "", turning.c_str(), "step"}};
  for (const LimitCase& c : cases) {
    INFO(std::string(c.name), ": ", std::string(c.path));
    std::string text = held_arm(c.top, c.spring);
    if (std::string(c.spring).find("torsional") != std::string::npos) text = pointless(text);
    const std::vector<LabParameter> parameters = predicted(text);
    const LabParameter& parameter = parameter_at(parameters, c.path);
    REQUIRE(parameter.limit);
    REQUIRE(parameter.limit->value);
    const double limit = *parameter.limit->value;
    CHECK(parameter.limit->state == "ok");
    INFO(limit);
    CHECK(is_stable(text, fmt::format("{}={}", c.path, 0.9 * limit)));
    CHECK(!is_stable(text, fmt::format("{}={}", c.path, 1.15 * limit)));
  }
}

TEST_CASE(
    "parameters: a held force is stable at the predicted rate, and unstable a quarter below") {
  const std::string text =
      held_arm("", "type = \"linear\"\nstiffness = 4000\ndamping = 40\nrate = 500");
  const std::vector<LabParameter> parameters = predicted(text);
  const LabParameter& parameter = parameter_at(parameters, "coupling[1].rate");
  REQUIRE(parameter.limit);
  REQUIRE(parameter.limit->value);
  const long steps = std::lround(1 / (*parameter.limit->value * 1e-3));
  CHECK(steps > 2);
  const auto at = [&](long n) { return fmt::format("coupling[1].rate={}", 1000.0 / double(n)); };
  CHECK(is_stable(text, at(steps)));
  CHECK(!is_stable(text, at(steps + steps / 4 + 1)));
}

TEST_CASE("parameters: `near` within a quarter of the limit; beyond it the stable value is given") {
  const std::string text = held_arm("", std::string(kLinear) + "discretization = \"explicit\"");
  const auto limit_at = [&](const std::vector<std::string>& changes) {
    return *parameter_at(predicted(text, changes), "coupling.stiffness").limit;
  };
  const ParameterLimit at_start = limit_at({});
  REQUIRE(at_start.value);
  const auto with = [&](double part) {
    return limit_at({fmt::format("coupling.stiffness={}", part * *at_start.value)});
  };
  CHECK(with(0.70).state == "ok");
  CHECK(with(0.80).state == "near");
  CHECK(with(1.30).state == "beyond");
  // From above the limit is the same.
  CHECK(*with(1.30).value == doctest::Approx(*at_start.value).epsilon(0.02));
  CHECK(!with(1.30).words.empty());
  const ParameterLimit implicit = limit_at({"coupling.discretization=implicit"});
  CHECK(!implicit.value);
  CHECK(implicit.state == "ok");
  CHECK(!implicit.words.empty());
}

TEST_CASE("parameters: in an unstable scene only those that stabilise it alone have a limit") {
  // The linear spring is beyond its limit, the torsional one is not.
  std::string text = held_arm("",
                              "type = \"linear\"\nstiffness = 2e4\ndamping = 40\n"
                              "discretization = \"explicit\"");
  const std::vector<LabParameter> at_start = predicted(text);
  const double limit = *parameter_at(at_start, "coupling[0].stiffness").limit->value;
  const std::string too_stiff = fmt::format("coupling[0].stiffness={}", 3 * limit);
  const std::vector<LabParameter> one = predicted(text, {too_stiff});
  CHECK(parameter_at(one, "coupling[0].stiffness").limit->state == "beyond");
  CHECK(parameter_at(one, "step").limit->state == "beyond");
  CHECK(parameter_at(one, "step").limit->value);
  CHECK_FALSE(parameter_at(one, "coupling[1].stiffness").limit);
  CHECK_FALSE(parameter_at(one, "coupling[1].damping").limit);
  // Both beyond: a shorter step stabilises, neither gain alone does.
  const std::vector<LabParameter> both =
      predicted(text, {too_stiff, fmt::format("coupling[1].stiffness={}", 100 * limit)});
  CHECK_FALSE(parameter_at(both, "coupling[0].stiffness").limit);
  CHECK_FALSE(parameter_at(both, "coupling[1].stiffness").limit);
  CHECK(parameter_at(both, "step").limit->value);
}

TEST_CASE("parameters: the initial value is that of the scene's file, whatever was changed since") {
  const auto file = read_gallery().front().file;
  const std::vector<LabParameter> unchanged = parameters_of(planned(file, {}));
  std::vector<LabParameter> parameters = parameters_of(
      planned(file, {"coupling[0].stiffness=123", "step=0.0005", "coupling[0].type=weld"}));
  set_initial_values(unchanged, parameters);
  std::vector<std::string> back;
  for (const LabParameter& parameter : parameters) {
    INFO(parameter.path);
    const auto before =
        std::find_if(unchanged.begin(), unchanged.end(),
                     [&](const LabParameter& other) { return other.path == parameter.path; });
    CHECK(parameter.initial.has_value() == (before != unchanged.end()));
    if (parameter.initial)
      CHECK(parameter.path + "=" + *parameter.initial == before->path + "=" + before->value());
    if (parameter.initial && parameter.initial != parameter.value()) back.push_back(parameter.path);
  }
  CHECK(std::count(back.begin(), back.end(), "step") == 1);
  CHECK(std::count(back.begin(), back.end(), "coupling[0].type") == 1);
  CHECK_FALSE(
      parameter_at(parameters, "coupling[0].time_constant").initial);  // the file has no such key
}

TEST_CASE("parameters: the predicted tracking error equals that after a velocity step of 1 rad/s") {
  // One joint alone: peak of e'' = -w^2 e - 2 z w e', e(0) = 0, e'(0) = 1 rad/s.
  const std::string text = R"(
gravity = [0, 0, 0]
[[robot]]
name = "arm"
model = "robots/s103/s103.urdf"
lock = ["joint2", "joint3", "gripper_lift"]
collide = false
[[coupling]]
type = "torsional"
measure = "joint"
link = "arm1"
stiffness = 500
damping = 0
)";
  const std::vector<LabParameter> parameters = predicted(text);
  const std::string lag = parameter_at(parameters, "coupling[0].stiffness").tracking_error;
  // Inertia from the period: first zero of a run from 1e-3 rad.
  SimulatePlan swing =
      planned(temporary_scene("lag", text),
              {"coupling.discretization=explicit", "step=1e-4", "robot.qd.joint1=0.001"}, 20000);
  double quarter = 0;
  RunWatch watch;
  watch.look = [&](SteppedRun& run) {
    if (quarter == 0 && run.simulation().state().qd[0] < 0) quarter = run.simulation().state().t;
  };
  run_plan(swing.input, swing.run, watch);
  REQUIRE(quarter > 0);
  const double peak = quarter / (std::numbers::pi / 2) * 180 / std::numbers::pi;  // v / w
  CHECK(lag == fmt::format("peak {:.2g}° after a velocity step of 1 rad/s", peak));
}

TEST_CASE("parameters: a coupling's type changes from linear to torsional, without its point") {
  const auto file = read_gallery().front().file;
  const std::vector<LabParameter> parameters = parameters_of(planned(file, {}));
  for (const std::string& type : parameter_at(parameters, "coupling[0].type").choices) {
    INFO(type);
    const SimulatePlan plan = planned(file, {"coupling[0].type=" + type}, 10);
    const CouplingDescription& now = plan.input.scene->description.couplings[0];
    CHECK(facts_of(now.law, now.printed).name == type);
    CHECK(!ran(plan, 10).stopped);
  }
}

TEST_CASE("presets: each has a scene, and the input source that it names") {
  const auto folder = read_gallery().front().file.parent_path();
  CHECK(all_presets().size() == 4);
  for (const Preset& preset : all_presets()) {
    INFO(preset.name);
    const SimulatePlan plan = planned(folder / preset.scene, preset.changes);
    const auto target = plan.input.scene->couplings[0].target.kind;
    CHECK((target == CouplingTarget::Kind::paper) == (preset.hand == "scene"));
    CHECK((target == CouplingTarget::Kind::device) == (preset.hand == "drag"));
    CHECK(std::ranges::count(all_presets(), preset.name, &Preset::name) == 1);
  }
}

TEST_CASE("gallery: variants of an entry are read, and their faults reported") {
  const auto gallery = read_gallery();
  const VariantSet variants =
      std::ranges::find(gallery, "six_integrators", &GalleryScene::name)->variants;
  CHECK(variants.path == "integrator");
  CHECK(variants.values.size() == 6);
  CHECK(variants.apart.has_value());
  const auto entry = [](const std::string& told) {
    return temporary_scene("variants",
                           "[[scene]]\nname = \"a\"\nfile = \"no.toml\"\ntitle = \"t\"\n"
                           "look = [\"one\", \"two\", \"three\"]\nvariants = " +
                               told);
  };
  for (const char* told : {"{ path = \"step\", values = [0.1] }", "{ values = [0.1, 0.2] }",
                           "{ path = \"step\", values = [0.1, 0.1] }", "3"}) {
    CAPTURE(told);
    const auto faults = faults_of([&] { read_gallery(entry(told)); });
    REQUIRE(faults.size() == 2);  // the file is not there either
    CHECK(faults[1].where.find("variants") != std::string::npos);
  }
}

TEST_CASE("gallery: every scene has a picture, and faults are reported together") {
  const auto gallery = read_gallery();
  CHECK(gallery.size() >= 16);
  CHECK(gallery.front().name == "study");
  for (const GalleryScene& scene : gallery) {
    INFO(scene.name);
    CHECK(!scene.picture.empty());
    CHECK(std::ranges::count(gallery, scene.name, &GalleryScene::name) == 1);
  }
  try {
    read_gallery(temporary_scene("gallery",
                                 "[[scene]]\nname = \"a\"\nfile = \"no.toml\"\n"
                                 "title = \"t\"\nlook = [\"one\"]\nmore = 1\n"));
    FAIL("it was read");
  } catch (const InputError& error) {
    CHECK(error.faults().size() == 3);
  }
}
