// The inspector's message of a frame against the run of the frame.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/inspect/report/inspect_output.h"
#include "app/lab/run/lab_run.h"
#include "tests/app/lab/inspector/inspection_messages.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

constexpr const char* kInspectedScenes[] = {
    "hand_and_obstacles",     "box_stack", "four_bar", "incline",
    "robot_beside_obstacles", "turntable"};

const Value* quantity_of(const Value& passes, int pass, const std::string& name) {
  for (const Value& step : passes.items)
    if (at(step, "pass").number == pass)
      for (const Value& quantity : at(step, "quantities").items)
        if (at(quantity, "name").text == name) return &at(quantity, "value");
  return nullptr;
}

}  // namespace

TEST_CASE("inspector: accelerations and contact forces equal those of the run's next step") {
  for (const std::string name : kInspectedScenes) {
    CAPTURE(name);
    InspectedRun sample("scenes/" + name + ".toml", 120);
    const Model<double>& model = sample.model();
    double size = 1;
    for (const double qdd : sample.qdd) size = std::max(size, std::abs(qdd));
    std::size_t pressing = 0;
    for (std::size_t body = 1; body < model.parent.size(); ++body) {
      CAPTURE(model.body_name[body]);
      const Value message = sample.message(body, false);
      CHECK(at(message, "scene").number == 1);
      CHECK(at(message, "name").text == model.body_name[body]);
      if (model.dofs(body) == 1) {
        const Value* qdd = quantity_of(at(message, "passes"), 3, "qdd");
        REQUIRE(qdd);
        CHECK(std::abs(qdd->number - sample.qdd[model.iv[body]]) <= 1e-9 * size);
      }
      for (const Value& force : at(message, "forces").items) {
        if (!force.find("axis")) continue;
        const Vector3 on = vector_of(at(at(force, "on").items[0], "force"));
        CHECK(std::ranges::any_of(sample.force, [&](const Vector3& f) {
          return (f - on).norm() <= 1e-9 * std::max(1.0, f.norm());
        }));
        ++pressing;
      }
    }
    CHECK((pressing > 0) == !sample.force.empty());
  }
}

TEST_CASE("inspector: wrenches of every body and residuals of all equations sum to zero") {
  for (const std::string name : kInspectedScenes) {
    CAPTURE(name);
    InspectedRun sample("scenes/" + name + ".toml", 77);
    for (std::size_t body = 1; body < sample.model().parent.size(); ++body) {
      const Value message = sample.message(body, true);
      const Value& balance = at(message, "balance").items.at(0);
      Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
      double largest = 0;
      for (const Value& wrench : at(balance, "wrenches").items) {
        const Vector3 f = vector_of(at(wrench, "force")), n = vector_of(at(wrench, "torque"));
        force += f;
        torque += n;
        largest = std::max({largest, f.norm(), n.norm()});
      }
      CHECK(force.norm() <= 1e-9 * largest);
      CHECK(torque.norm() <= 1e-9 * largest);
      CHECK(at(message, "equations").items.size() > 4);
      for (const Value& equation : at(message, "equations").items) {
        CAPTURE(at(equation, "text").text);
        CHECK(at(equation, "residual").number <= 1e-9);
      }
      for (const Value& check : at(message, "checks").items)
        CHECK_MESSAGE(at(check, "pass").number == 1, at(check, "name").text);
    }
  }
}

TEST_CASE("inspector: values equal those of `inspect`; the energy balance is the frame's") {
  const std::string file = "scenes/hand_and_obstacles.toml";
  InspectedRun sample(file, 50);
  SimulatePlan& plan = sample.plan;
  StateArchive memory = simulation_memory(sample.frame.recorded.memory);
  Inspected inspected = SceneInspector(plan.input, plan.run.step).look(&memory);
  const Inspection in(plan.input.robot.model, inspected.x, inspected.actors, inspected.loops);
  JsonWriter json;
  json.begin_object();
  write_passes(json.key("passes"), in, {1, 2, 3}, {2});
  std::string wanted = json.str();
  wanted = wanted.substr(wanted.find("\"passes\""));
  for (int again = 0; again < 3; ++again) {  // independent of earlier requests
    const std::string message = sample.text(sample.frame, 2, again == 1);
    CHECK(message.find(wanted) != std::string::npos);
    const Value tree = parsed(message);
    const Value& energy_balance = at(tree, "energy_balance");
    for (std::size_t i = 0; i < sample.energy_balance.size(); ++i)
      CHECK(at(energy_balance, sample.energy_balance[i]).number == sample.frame.recorded.works[i]);
    sample.text(sample_of(file, 10).frame, 1, true);
  }
}

TEST_CASE("inspector: operator motion continues at its rate, and the mouse spring acts") {
  SimulateOptions options;
  options.robot.model = TWINARM_SOURCE_DIR "/assets/scenes/hand_and_obstacles.toml";
  options.duration = 1;
  const LabScene scene(options);
  OperatorInput hand;
  LabRun run(scene.plan(), hand);
  hand.choose(OperatorInput::Source::joints);
  hand.joint(0, 2.5);  // farther than it gets
  for (int n = 0; n < 100; ++n) REQUIRE(run.step());
  LabNames names;
  const LabFrame frame = run.frame(names);
  REQUIRE(frame.hand);
  CHECK(frame.hand->active);
  CHECK(frame.hand->qd_K.at(0) == doctest::Approx(OperatorInput::kMaxJointSpeed));
  BodyInspector inspector(std::move(scene.plan()->prepared));
  const Model<double>& model = run.prepared().input.robot.model;
  const auto body = static_cast<std::size_t>(model.find_joint("joint1"));
  REQUIRE(run.step());
  const double wanted = run.view().simulation().mechanism().w.qdd[model.iv[body]];
  CHECK(std::abs(wanted) > 0.1);
  const auto inspected_qdd = [&](const LabFrame& of) {
    const Value message = parsed(inspector.message(of, {body, true, 1, &names.rows}));
    for (const Value& check : at(message, "checks").items) CHECK(at(check, "pass").number == 1);
    const Value* qdd = quantity_of(at(message, "passes"), 3, "qdd");
    REQUIRE(qdd);
    return qdd->number;
  };
  CHECK(inspected_qdd(frame) == doctest::Approx(wanted).epsilon(1e-9));
  // With a target at rest the acceleration differs.
  LabFrame still = frame;
  still.hand->qd_K.assign(still.hand->qd_K.size(), 0);
  CHECK(std::abs(inspected_qdd(still) - wanted) > 1e-3 * std::abs(wanted));
  LabFrame pulled = frame;
  pulled.mouse =
      MouseSpringState{static_cast<int>(body), Vector3::Zero(), Vector3::Zero(), {0, 0, 10}};
  const Value message = parsed(inspector.message(pulled, {body, false, 1}));
  bool found = false;
  for (const Value& wrench : at(at(message, "balance").items.at(0), "wrenches").items)
    if (at(wrench, "source").text == "mouse")
      found = (vector_of(at(wrench, "force")) - Vector3(0, 0, 10)).norm() < 1e-12;
  CHECK(found);
}

TEST_CASE("inspector: while paused all bodies come in the order of the call") {
  InspectedRun sample("scenes/robot_beside_obstacles.toml", 5);
  std::vector<std::string> names(sample.model().body_name.begin() + 1,
                                 sample.model().body_name.end());
  CHECK(!sample.message(1, false).find("rows"));
  const Value message = sample.message(1, true);
  std::vector<std::pair<int, std::string>> order, wanted;
  for (const Value& row : at(message, "rows").items) {
    order.emplace_back(static_cast<int>(at(row, "pass").number), at(row, "body").text);
    // Bodies that are fixed to their parents have neither D nor u.
    CHECK((at(row, "pass").number == 2 || !at(row, "quantities").items.empty()));
  }
  for (const int pass : {1, 2, 3}) {
    if (pass > 1) std::reverse(names.begin(), names.end());
    for (const std::string& body : names) wanted.emplace_back(pass, body);
  }
  CHECK(order == wanted);
}

TEST_CASE("inspector: a robot without a scene") {
  InspectedRun sample("robots/s103/s103.urdf", 40);
  const auto body = static_cast<std::size_t>(sample.model().find_joint("joint1"));
  const Value message = sample.message(body, true);
  const Value* qdd = quantity_of(at(message, "passes"), 3, "qdd");
  REQUIRE(qdd);
  CHECK(std::isfinite(qdd->number));
  for (const Value& check : at(message, "checks").items) CHECK(at(check, "pass").number == 1);
}

TEST_CASE("inspector: values that are not finite and frames of another scene give warnings") {
  InspectedRun sample("scenes/hand_and_obstacles.toml", 20);
  const std::string good = sample.text(sample.frame, 1, true);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200}) {
    CAPTURE(bad);
    LabFrame broken = sample.frame;
    StateArchive memory = simulation_memory(broken.recorded.memory);
    const std::size_t head = broken.recorded.memory.size();
    std::vector<double> q;
    memory.visit(q);
    REQUIRE(q.size() > 1);
    // The first coordinate follows the run's own numbers and the number of coordinates.
    StateArchive written;
    written.visit(q);
    const std::size_t place = broken.recorded.memory.find(written.bytes()) + sizeof(std::uint64_t);
    REQUIRE(place < head);
    broken.recorded.memory.replace(place, sizeof bad, reinterpret_cast<const char*>(&bad),
                                   sizeof bad);
    const Value message = parsed(sample.text(broken, 1, true));
    CHECK(at(message, "kind").text == "inspection");
    if (std::isnan(bad)) CHECK(!at(message, "warnings").items.empty());
  }
  const RunSample other = sample_of("scenes/box_stack.toml", 3);
  const Value message = parsed(sample.text(other.frame, 1, true));
  CHECK(at(message, "warnings").items.size() == 1);
  CHECK(!message.find("passes"));
  CHECK(sample.text(sample.frame, 1, true) == good);
}
