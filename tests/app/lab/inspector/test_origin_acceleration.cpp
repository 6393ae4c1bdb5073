// The acceleration of a body's origin in the lab's inspector: classical, not spatial.
#include <doctest/doctest.h>

#include "tests/app/lab/inspector/inspection_messages.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// The classical acceleration of the origin of a body, of the rows of pass 3.
Vector3 acceleration_of(const Value& message, const std::string& body) {
  for (const Value& row : at(message, "rows").items)
    if (at(row, "pass").number == 3 && at(row, "body").text == body)
      for (const Value& quantity : at(row, "quantities").items)
        if (at(quantity, "name").text == "acceleration") return vector_of(at(quantity, "value"));
  FAIL("no acceleration of body " << body);
  return {};
}

}  // namespace

TEST_CASE("inspector: the acceleration of an origin is classical: w^2 r on a circle, 0 at rest") {
  const TemporaryFolder folder;
  const auto link = [](const std::string& name) {
    return "<link name='" + name +
           "'><inertial><mass value='1'/><inertia ixx='0.1' iyy='0.1' izz='0.1' ixy='0' ixz='0' "
           "iyz='0'/></inertial></link>";
  };
  SimulateOptions options;
  options.duration = 1;
  options.robot.model = folder.write(
      "two.urdf", "<robot name='two'><link name='base'/>" + link("a") + link("b") +
                      "<joint name='j1' type='continuous'><parent link='base'/><child link='a'/>"
                      "<axis xyz='0 0 1'/></joint>"
                      "<joint name='j2' type='continuous'><origin xyz='0.5 0 0'/><parent "
                      "link='a'/><child link='b'/><axis xyz='0 0 1'/></joint></robot>");
  for (const double w : {0.0, 6.0}) {
    CAPTURE(w);
    options.robot.state =
        folder.write("state.json", "{\"qd\": {\"j1\": " + std::to_string(w) + "}}");
    BodyInspector inspector(prepare_simulation(options));
    const RunSample sample = sample_of(prepare_simulation(options), 0);
    const Value message = parsed(inspector.message(sample.frame, {2, true, 1}));
    CHECK(acceleration_of(message, "a").norm() < 1e-12);
    CHECK((acceleration_of(message, "b") - Vector3(-0.5 * w * w, 0, 0)).norm() < 1e-12);
  }
}

TEST_CASE("inspector: the acceleration of an origin is the second derivative of its position") {
  InspectedRun sample("robots/s103/s103.urdf", 200);
  const Model<double>& model = sample.model();
  const Value message = sample.message(1, true);
  StateArchive memory = simulation_memory(sample.frame.recorded.memory);
  State<double> x(model);
  memory.visit(x.q);
  memory.visit(x.qd);
  Kinematics k(model);
  for (std::size_t body = 1; body < model.parent.size(); ++body) {
    // q and qd along the parabola of qdd: central differences of the velocity.
    const double h = 1e-5;
    Vector3 v[2];
    for (const double side : {-1.0, 1.0}) {
      State<double> moved = x;
      for (std::size_t dof = 0; dof < model.nv; ++dof) {
        moved.q[dof] += side * h * x.qd[dof];
        moved.qd[dof] += side * h * sample.qdd[dof];
      }
      forward_kinematics(model, moved, k);
      v[side > 0] = k.v_WLo[body];
    }
    const Vector3 wanted = (v[1] - v[0]) / (2 * h);
    CHECK((acceleration_of(message, model.body_name[body]) - wanted).norm() <
          1e-6 * (1 + wanted.norm()));
  }
}
