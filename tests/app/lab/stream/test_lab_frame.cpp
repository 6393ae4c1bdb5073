// Binary frames, decoded by the protocol's table, against the run.
#include <array>
#include <cmath>
#include <limits>

#include "app/lab/stream/frame_bytes.h"
#include "solver/dynamics/kinematics.h"
#include "tests/app/lab/stream/watched.h"

namespace twinarm {
namespace {

void check_pose(const std::array<float, 7>& pose, const Pose& X_WL) {
  CHECK((Vector3(pose[0], pose[1], pose[2]) - X_WL.p).norm() < 1e-6);
  const Eigen::Quaterniond rotation(pose[6], pose[3], pose[4], pose[5]);
  CHECK((rotation.toRotationMatrix() - X_WL.R).cwiseAbs().maxCoeff() < 1e-6);
}

// The frame with another first coordinate in its checkpoint.
LabFrame with_first_q(LabFrame frame, double old, double value) {
  std::string& memory = frame.recorded.memory;
  const std::string from(reinterpret_cast<const char*>(&old), sizeof old);
  const std::size_t at = memory.find(from);
  REQUIRE(at != std::string::npos);
  memory.replace(at, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
  return frame;
}

TEST_CASE("lab frame: the header has the values of session and run, and the arrays fill the rest") {
  Watched watched = watched_boxes();
  LabFrame frame = watched.after(5);
  frame.input_stamp = 12.5;
  FrameFacts facts;
  facts.number = 41;
  facts.paused = true;
  facts.stopped = true;
  facts.input_age = 0.011;
  const std::string bytes = watched.view->frame(frame, nullptr, all_layers(watched), facts);
  const ReadFrame read(bytes);
  CHECK(bytes.substr(0, 4) == "TWF1");
  CHECK(read.scene == 7);
  CHECK(read.time == frame.recorded.t);
  CHECK(read.stamp == 12.5);
  CHECK(read.age == 0.011);
  CHECK(read.step == 5);
  CHECK(read.number == 41);
  CHECK(read.flags == 5);
  CHECK(read.end == bytes.size());
  CHECK(read.channels.size() == texts_in(watched.view->scene_message(), "channels", "name").size());
  CHECK(read.works.size() == watched.names.rows.size());
  CHECK(read.first.size() == all_layers(watched).size() + 1);
}

TEST_CASE("lab frame: poses of bodies equal forward kinematics") {
  Watched watched = watched_boxes();
  const LabFrame frame = watched.after(70);
  const ReadFrame read(watched.view->frame(frame, nullptr, {}, {}));
  const Model<double>& model = watched.plan->prepared.input.robot.model;
  Kinematics k(model);
  forward_kinematics(model, watched.run->view().simulation().state(), k);
  const auto bodies = texts_in(watched.view->scene_message(), "bodies", "name");
  std::vector<std::string> seen;
  for (std::size_t i = 0; i < read.instances(); ++i) {
    REQUIRE(read.body[i] < bodies.size());
    const Pose& X_WL = k.X_WL[read.body[i]];
    seen.push_back(bodies[read.body[i]]);
    CHECK((position_of(read, i) - X_WL.p).norm() < 1e-6);
    // Half a unit of each of four numbers, at most.
    CHECK((rotation_of(read, i) - X_WL.R).cwiseAbs().maxCoeff() < 4.0 / 32767);
    const bool rests = seen.back() == "resting";
    const Vector3 size = rests ? Vector3(0.4, 0.3, 0.2) : Vector3(0.1, 0.2, 0.3);
    for (int c = 0; c < 3; ++c)
      CHECK(read.scale[3 * i + static_cast<std::size_t>(c)] == static_cast<float>(size[c]));
  }
  CHECK(seen == std::vector<std::string>{"resting", "spinning"});
  REQUIRE(read.link.size() == 7 * bodies.size());
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    check_pose(ReadFrame::pose(read.link, body), k.X_WL[body]);
    CHECK(std::isnan(ReadFrame::pose(read.target, body)[0]));  // no target robot
  }
}

TEST_CASE("lab frame: channels and works are those of the recorded frame, by name") {
  Watched watched = watched_boxes();
  const LabFrame frame = watched.after(40);
  const ReadFrame read(watched.view->frame(frame, nullptr, {}, {}));
  const auto at = [&](const std::string& name) {
    return read.channels.at(watched.place_of("channels", "name", name));
  };
  for (std::size_t i = 0; i < watched.header.columns.size(); ++i)
    CHECK(at(watched.header.columns[i].name) == frame.recorded.values[i]);
  Vector3 force = Vector3::Zero();
  for (const RecordedContact& c : frame.recorded.contacts) force += c.force;
  CHECK(force.norm() == doctest::Approx(2 * 9.81).epsilon(1e-6));  // resting mass of 2 kg
  CHECK(at("contact/floor-resting") == doctest::Approx(force.norm()).epsilon(1e-14));
  CHECK(std::isnan(at("mouse_spring")));
  CHECK(std::isnan(at("device/force")));
  CHECK(at("time/speed_ratio") == frame.pace);
  CHECK(at("contacts/residual") == frame.residual);
  CHECK(at("contacts/penetration") < 1e-3);
  CHECK(at("contacts/asleep") == 0);
  REQUIRE(frame.recorded.works.size() == watched.names.rows.size());
  for (std::size_t i = 0; i < frame.recorded.works.size(); ++i)
    CHECK(read.works[frame.recorded.rows[i]] == frame.recorded.works[i]);
}

TEST_CASE("lab frame: layers are consecutive; those not requested are empty") {
  Watched watched = watched_boxes();
  const LabFrame frame = watched.after(20);
  const std::vector<std::string> names = all_layers(watched);
  const ReadFrame all(watched.view->frame(frame, nullptr, names, {}));
  CHECK(all.first.front() == 0);
  CHECK(all.first.back() == all.instances());
  CHECK(all.first_label.back() == all.text_end.size());
  CHECK(std::is_sorted(all.first.begin(), all.first.end()));
  CHECK(names.front() == "bodies");
  CHECK(names.back() == "earlier-run");
  for (const std::string wanted : {"gravity", "labels", "forces"}) {
    const ReadFrame one(watched.view->frame(frame, nullptr, {wanted}, {}));
    for (std::size_t l = 0; l < names.size(); ++l) {
      const bool is_there = l == 0 || names[l] == wanted;
      CHECK(one.first[l + 1] - one.first[l] == (is_there ? all.first[l + 1] - all.first[l] : 0));
      CHECK(one.labels_of(l) == (is_there ? all.labels_of(l) : std::vector<std::string>{}));
    }
  }
  CHECK(all.labels_of(watched.layer("labels")) == std::vector<std::string>{"resting", "spinning"});
  CHECK(all.labels_of(watched.layer("forces")) == std::vector<std::string>{"19.6 N"});
  // The weight of the resting box points down from its centre.
  const auto [first, last] = all.layer(watched.layer("gravity"));
  REQUIRE(last == first + 4);  // two arrows of shaft and head
  CHECK((position_of(all, first) - Vector3(0.5, 0, 0.1)).norm() < 1e-3);
  CHECK(rotation_of(all, first).col(2).z() < -0.9999);
  CHECK(all.body[first] == all.body[0]);
}

TEST_CASE("lab frame: the target robot has the operator's pose, also at an unchanged time") {
  Watched watched = watched_arm();
  LabFrame frame = watched.after(3);
  REQUIRE(frame.hand);
  REQUIRE(frame.hand->q_K.size() == 3);
  const Model<double>& model = watched.plan->prepared.input.robot.model;
  const std::size_t targets = watched.layer("targets");
  const int tip = model.find_body("quill");
  REQUIRE(tip > 0);
  frame.hand->active = true;
  for (const double angle : {0.3, -0.5, 0.3}) {
    frame.hand->q_K = {angle, 0.4, -0.2};
    State<double> x = watched.plan->prepared.input.robot.state.x;
    const char* const joints[] = {"joint1", "joint2", "joint3"};
    for (std::size_t j = 0; j < 3; ++j)
      x.q[model.iq[static_cast<std::size_t>(model.find_joint(joints[j]))]] = frame.hand->q_K[j];
    Kinematics k(model);
    forward_kinematics(model, x, k);
    const ReadFrame read(watched.view->frame(frame, nullptr, {"targets"}, {}));
    const std::size_t first = read.first[targets], last = read.first[targets + 1];
    Kinematics now(model);
    forward_kinematics(model, watched.run->view().simulation().state(), now);
    // Pose of a link from the same part of the robot, whose link has the pose in `now`.
    const auto is_like = [&](std::size_t i, std::size_t j) {
      return read.body[i] == read.body[j] && read.mesh[i] == read.mesh[j];
    };
    int seen = 0;
    std::size_t j = 0;  // parts come in the same order
    for (std::size_t i = first; i < last; ++i, ++j) {
      while (j < first && !is_like(i, j)) ++j;
      REQUIRE(j < first);
      const Pose& X_WL = now.X_WL[read.body[j]];
      const Vector3 p_L = X_WL.R.transpose() * (position_of(read, j) - X_WL.p);
      CHECK((position_of(read, i) - k.X_WL[read.body[i]] * p_L).norm() < 1e-5);
      seen += read.body[i] == tip ? 1 : 0;
    }
    CHECK(seen > 0);
    for (int body = 1; body < model.body_count(); ++body) {
      const auto i = static_cast<std::size_t>(body);
      check_pose(ReadFrame::pose(read.target, i), k.X_WL[i]);
      check_pose(ReadFrame::pose(read.link, i), now.X_WL[i]);
    }
    const auto at = [&](const char* name) {
      return read.channels.at(watched.place_of("channels", "name", name));
    };
    CHECK(at("target/joint1") == doctest::Approx(angle).epsilon(1e-14));
    CHECK(at("error/joint1") == doctest::Approx(at("q/joint1") - angle).epsilon(1e-14));
  }
}

TEST_CASE("lab frame: the run that was left is shown only where it differs") {
  Watched watched = watched_boxes();
  const LabFrame earlier = watched.after(5), now = watched.after(100);
  const std::size_t before = watched.layer("earlier-run");
  const ReadFrame same(watched.view->frame(now, &now, {"earlier-run"}, {}));
  CHECK(same.first[before] == same.first[before + 1]);
  const ReadFrame read(watched.view->frame(now, &earlier, {"earlier-run"}, {}));
  const auto [first, last] = read.layer(before);
  REQUIRE(last == first + 1);  // the resting one has not moved
  CHECK(read.color[4 * first + 3] < 255);
  const Model<double>& model = watched.plan->prepared.input.robot.model;
  const auto spinning = static_cast<std::size_t>(model.find_body("spinning"));
  CHECK(read.body[first] == spinning);
  const auto& values = earlier.recorded.values;
  const auto& columns = watched.header.columns;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string name = std::string("links/spinning/") + "xyz"[c];
    const auto found = std::find_if(columns.begin(), columns.end(),
                                    [&](const RunColumn& column) { return column.name == name; });
    REQUIRE(found != columns.end());
    CHECK(read.position[3 * first + c] ==
          doctest::Approx(values[static_cast<std::size_t>(found - columns.begin())]).epsilon(1e-6));
  }
}

TEST_CASE("lab frame: the device force is an arrow at the stylus, proportional to the force") {
  Watched watched = watched_arm();
  LabFrame frame = watched.after(1);
  REQUIRE(frame.hand);
  frame.hand->active = true;
  frame.hand->theta = {0.2, 0.7, 0.1, 0, 0, 0};
  const std::size_t layer = watched.layer("device-force");
  const auto length = [&](double newton) {
    frame.hand->force_W = newton * Vector3(0, 0.6, 0.8);
    const ReadFrame read(watched.view->frame(frame, nullptr, {"device-force"}, {}));
    const auto [first, last] = read.layer(layer);
    double reach = 0;  // from the point to the tip of the first arrow: shaft, head
    if (last > first) {
      CHECK((rotation_of(read, first).col(2) - Vector3(0, 0.6, 0.8)).norm() < 1e-3);
      reach = read.scale[3 * first + 2] + read.scale[3 * first + 5];
    }
    return std::pair(reach, read.labels_of(layer));
  };
  const auto [one, text] = length(1.1);
  const auto [two, most] = length(3.3);
  CHECK(text == std::vector<std::string>{"1.10 of 3.3 N"});
  CHECK(most == std::vector<std::string>{"3.30 of 3.3 N"});
  CHECK(two == doctest::Approx(3 * one).epsilon(1e-5));
  CHECK(length(0).first == 0);
}

TEST_CASE("lab frame: the mouse spring is drawn from the body's point to the goal") {
  Watched watched = watched_boxes();
  LabFrame frame = watched.after(1);
  const Model<double>& model = watched.plan->prepared.input.robot.model;
  frame.mouse = MouseSpringState{model.find_body("resting"), Vector3(0.2, 0, 0),
                                 Vector3(0.9, 0, 0.5), Vector3(7, 0, 0)};
  const ReadFrame read(watched.view->frame(frame, nullptr, {"mouse-spring"}, {}));
  const std::size_t pull = watched.layer("mouse-spring");
  const auto [first, last] = read.layer(pull);
  REQUIRE(last > first);
  CHECK((position_of(read, first) - Vector3(0.7, 0, 0.1)).norm() < 1e-4);
  CHECK(read.scale[3 * first + 2] == doctest::Approx(std::hypot(0.2, 0.4)).epsilon(1e-3));
  CHECK(read.labels_of(pull) == std::vector<std::string>{"7 N"});
  CHECK(read.channels.at(watched.place_of("channels", "name", "mouse_spring")) == 7);
}

TEST_CASE(
    "lab frame: a state that is not finite gives no instance of that body, and no exception") {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  for (const double bad : {kNaN, kInf, -kInf, 1e300, 1e30, 1e11}) {
    CAPTURE(bad);
    Watched watched = watched_boxes();
    const double x = watched.run->view().simulation().state().q.at(7);  // of the second body
    const LabFrame frame = with_first_q(watched.after(0), x, bad);
    const std::string bytes = watched.view->frame(frame, nullptr, all_layers(watched), {});
    const ReadFrame read(bytes);
    CHECK(read.end == bytes.size());
    for (std::size_t i = 0; i < read.first[1]; ++i) CHECK(read.body[i] == read.body[0]);
    CHECK(read.first[1] == 1);
    for (const float p : read.position) CHECK(std::abs(p) < 1e10);
    for (const float p : read.label_position) CHECK(std::abs(p) < 1e10);
  }
}

TEST_CASE("lab frame: the arm in a state that is not finite gives no exception") {
  Watched watched = watched_arm();
  LabFrame frame = watched.after(2);
  State<double> x = watched.run->view().simulation().state();
  std::string& memory = frame.recorded.memory;
  const std::string q(reinterpret_cast<const char*>(x.q.data()), 8 * x.q.size());
  const std::size_t at = memory.find(q);
  REQUIRE(at != std::string::npos);
  for (double& value : x.q) value = std::numeric_limits<double>::quiet_NaN();
  memory.replace(at, q.size(), reinterpret_cast<const char*>(x.q.data()), q.size());
  const ReadFrame read(watched.view->frame(frame, &frame, all_layers(watched), {}));
  for (const float p : read.position) CHECK(std::isfinite(p));
}

}  // namespace
}  // namespace twinarm
