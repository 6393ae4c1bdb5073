#include "app/lab/inspector/body_inspector.h"

#include <exception>

#include "solver/forces/spring.h"

namespace twinarm {
namespace {

bool acts_on(const AppliedForce& force, const Model<double>& model, std::size_t body) {
  const auto is_of_body = [&](const AppliedForce::OnJoint& on) {
    return on.dof >= model.iv[body] && on.dof < model.iv[body] + model.dofs(body);
  };
  return std::ranges::find(force.bodies, body, &AppliedForce::OnBody::body) != force.bodies.end() ||
         std::ranges::any_of(force.joints, is_of_body);
}

void write_equations(JsonWriter& json, const Inspection& in, std::size_t body) {
  json.begin_array();
  for (const int pass : {1, 2, 3})
    for (const Equation& equation : equations_of(in, pass, body)) {
      const auto write_value_of = [&](const auto& of) {
        return [&] { write_value(json, of.value, equation.by_columns); };
      };
      const auto write_term = [&](const EquationTerm& term) {
        json.object({{"symbol", term.symbol},
                     {"words", term.words},
                     {"of", in.model.body_name[term.of]},
                     {"value", write_value_of(term)}});
      };
      json.object({{"pass", pass},
                   {"name", equation.name},
                   {"text", equation.text},
                   {"terms", [&] { json.list(equation.terms, write_term); }},
                   {"value", write_value_of(equation)},
                   {"residual", equation.residual}});
    }
  json.end_array();
}

using Names = std::initializer_list<std::string_view>;

std::vector<DisplayedQuantity> some_of(const Inspection& in, int pass, std::size_t body,
                                       Names names) {
  std::vector<DisplayedQuantity> all = shown_quantities(in, pass, body);
  std::erase_if(all, [&](const DisplayedQuantity& shown) {
    return std::ranges::find(names, shown.quantity.name) == names.end();
  });
  return all;
}

// The quantities of a neighbour that the body's equations use.
void write_neighbour(JsonWriter& json, const Inspection& in, std::size_t body, const char* relation,
                     Names names) {
  std::vector<DisplayedQuantity> used;
  for (const int pass : {1, 2, 3})
    for (DisplayedQuantity& shown : some_of(in, pass, body, names))
      used.push_back(std::move(shown));
  const auto quantities = [&] { write_quantities(json, used); };
  json.object({{"body", in.model.body_name[body]}, {"is", relation}, {"quantities", quantities}});
}

void write_neighbours(JsonWriter& json, const Inspection& in, std::size_t body) {
  json.begin_array();
  if (in.parent(body) > 0) write_neighbour(json, in, in.parent(body), "parent", {"v", "a"});
  for (const std::size_t child : in.children(body))
    write_neighbour(json, in, child, "child", {"Xup", "Ia", "pa"});
  json.end_array();
}

DisplayedQuantity origin_acceleration(const Inspection& in, std::size_t body) {
  return {{"acceleration", 3, Quantity::By::body, "acceleration of the link's origin", "m/s^2",
           "R (a_lin + w x v) + g, section 2.10"},
          "world axes",
          in.origin_acceleration(body)};
}

// The main results of each step of the call, in order.
void write_call(JsonWriter& json, const Inspection& in) {
  json.begin_array();
  const auto step = [&](int pass, std::size_t body, Names names) {
    std::vector<DisplayedQuantity> results = some_of(in, pass, body, names);
    if (pass == 3) results.push_back(origin_acceleration(in, body));
    json.object({{"pass", pass},
                 {"body", in.model.body_name[body]},
                 {"quantities", [&] { write_quantities(json, results); }}});
  };
  for (std::size_t i = 1; i < in.body_count(); ++i) step(1, i, {"v"});
  for (std::size_t i = in.body_count(); i-- > 1;) step(2, i, {"D", "u"});
  for (std::size_t i = 1; i < in.body_count(); ++i) step(3, i, {"qdd", "a"});
  json.end_array();
}

InspectView view_of(const Inspection& in, const LabFrame& frame, std::size_t body,
                    const std::vector<std::string>* rows) {
  InspectView view;
  view.bodies = {body};
  view.forces_alone = true;
  for (const AppliedForce& force : in.actors)
    if (acts_on(force, in.model, body)) view.forces.push_back(force.source);
  const RecordedFrame& recorded = frame.recorded;
  for (std::size_t i = 0; rows && i < std::min(recorded.rows.size(), recorded.works.size()); ++i)
    if (recorded.rows[i] < rows->size())
      view.energy_balance.push_back(
          {EnergyRowKind::earlier, (*rows)[recorded.rows[i]], recorded.works[i]});
  return view;
}

}  // namespace

BodyInspector::BodyInspector(SimulatePlan plan)
    : plan_(std::move(plan)),
      given_(plan_.input.robot.state),
      mouse_force_([&mouse = mouse_](const auto&, const Kinematics& k, Forces<double>& forces) {
        if (!mouse || mouse->body <= 0) return;
        add_point_force(k, mouse->body, k.position(mouse->body, mouse->p_L), mouse->force_W,
                        forces);
      }) {
  SimulateInput& input = plan_.input;
  input.robot.warnings.clear();  // reported when the scene was opened
  if (!input.scene) return;
  const double h = plan_.run.step;
  override_.emplace(input.scene.get(), unused_, h);
  input.couplings = std::make_unique<SceneCouplings>(*input.scene, h, nullptr, in_place());
  scene_.emplace(input, h, std::vector<NamedSource>{{"mouse", &mouse_force_}},
                 plan_.run.integrator);
}

// Replaces the motion of the couplings that the run's operator would drive.
MotionReplacement BodyInspector::in_place() {
  return [this, in_run = override_->in_place()](
             std::size_t coupling,
             std::unique_ptr<OperatorMotion> own) -> std::unique_ptr<OperatorMotion> {
    const OperatorMotion* before = own.get();
    std::unique_ptr<OperatorMotion> made = in_run(coupling, std::move(own));
    if (made.get() == before) return made;
    const auto substitute = [this](double, double) { return motion_ ? &*motion_ : nullptr; };
    return std::make_unique<OverridableMotion>(std::move(made), substitute);
  };
}

// The operator motion continued from the frame.
void BodyInspector::set_motion(const LabFrame& frame) {
  motion_.reset();
  if (!frame.hand || !frame.hand->active) return;
  const OperatorFrame& hand = *frame.hand;
  MappedTarget target{hand.q_K, hand.qd_K, hand.gripper_closed};
  target.qd.resize(target.q.size());
  for (std::size_t j = 0; j < target.q.size(); ++j) target.q[j] += plan_.run.step * target.qd[j];
  motion_.emplace(1);
  motion_->set(target, frame.recorded.t, plan_.run.step);
}

Inspected BodyInspector::inspect(const LabFrame& frame) {
  StateArchive memory = simulation_memory(frame.recorded.memory);
  if (scene_) {
    set_motion(frame);
    plan_.input.couplings->forget_operator_motions();
    mouse_ = frame.mouse;
    return scene_->look(&memory);
  }
  RobotInput& robot = plan_.input.robot;
  State<double> x(robot.model);
  visit_state(memory, robot.model, x);
  robot.state = given_;
  set_pose(robot, x);
  return inspect_robot(robot);
}

void BodyInspector::write(JsonWriter& json, const LabFrame& frame, const InspectRequest& request) {
  const Model<double>& model = plan_.input.robot.model;
  if (model.parent.size() < 2) throw std::runtime_error("the scene has no moving body");
  const bool is_body = request.body > 0 && request.body < model.parent.size();
  const std::size_t body = is_body ? request.body : 1;
  Inspected found = inspect(frame);
  const Inspection in(model, found.x, std::move(found.actors), std::move(found.loops));
  InspectView view = view_of(in, frame, body, request.rows);
  view.warnings = std::move(found.warnings);
  warn_of_bad_numbers(in, view.warnings);
  std::vector<Check> checks;
  if (request.paused) {
    checks = run_checks(in);
    if (scene_) checks.push_back(step_check(in, found.qdd_of_step));
  }
  json.members({{"body", body}, {"name", model.body_name[body]}});
  write_inspection(json, in, view, checks);
  write_equations(json.key("equations"), in, body);
  write_neighbours(json.key("neighbours"), in, body);
  if (request.paused) write_call(json.key("rows"), in);
}

std::string BodyInspector::message(const LabFrame& frame, const InspectRequest& request) {
  const auto text_with = [&](const auto& write_rest) {
    return json_text([&](JsonWriter& json) {
      json.members({{"kind", "inspection"},
                    {"scene", request.scene},
                    {"t", frame.recorded.t},
                    {"step", frame.recorded.step},
                    {"paused", request.paused}});
      write_rest(json);
    });
  };
  try {
    return text_with([&](JsonWriter& json) { write(json, frame, request); });
  } catch (const std::exception& error) {
    const std::string warning = std::string("this frame cannot be inspected: ") + error.what();
    return text_with([&](JsonWriter& json) { json.key("warnings").texts({warning}); });
  }
}

}  // namespace twinarm
