#include "app/lab/inspector/body_inspector.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "app/inspect/equations.h"
#include "app/inspect/report/inspect_input.h"
#include "app/inspect/report/inspect_output.h"
#include "app/lab/run/input_override.h"
#include "app/robot/dynamics.h"
#include "app/run/run.h"
#include "coupling/device/device_motion.h"
#include "solver/dynamics/world_kinematics.h"
#include "solver/forces/spring.h"
#include "solver/support/checkpointable.h"

namespace twinarm {
namespace {

// The newest hand of a frame, for all pulls that it leads.
struct FrameHand {
  std::optional<DeviceMotion> live;  // nothing: the scene's own hands lead

  void take(const LabFrame& frame, double h) {
    live.reset();
    if (!frame.hand || !frame.hand->leads) return;
    const LabHandFrame& hand = *frame.hand;
    HandTarget target{hand.q_K, hand.qd_K, hand.gripper_closed};
    target.qd.resize(target.q.size());
    for (std::size_t j = 0; j < target.q.size(); ++j) target.q[j] += h * target.qd[j];
    live.emplace(1);
    live->set(target, frame.recorded.t, h);
  }
};

// Those pulls that the run's hand would lead (input_override.h).
HandInPlace in_place_of(InputOverride& lead, const FrameHand& hand) {
  return [&hand, leads = lead.in_place()](
             std::size_t pull,
             std::unique_ptr<OperatorMotion> own) -> std::unique_ptr<OperatorMotion> {
    const OperatorMotion* before = own.get();
    std::unique_ptr<OperatorMotion> made = leads(pull, std::move(own));
    if (made.get() == before) return made;
    const auto instead = [&hand](double, double) { return hand.live ? &*hand.live : nullptr; };
    return std::make_unique<ReplacedHand>(std::move(made), instead);
  };
}

// The mouse's spring, with the force of the step that led to the frame.
class HeldPull final : public ForceSource, public Checkpointable {
 public:
  void hold(const std::optional<MousePoint>& pull) { pull_ = pull; }
  void add_forces(const State<double>&, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    if (!pull_ || pull_->body <= 0) return;
    add_point_force(k, pull_->body, k.position(pull_->body, pull_->p_L), pull_->force_W, forces);
  }

 private:
  std::optional<MousePoint> pull_;
};

bool acts_on(const AppliedForce& actor, const Model<double>& model, std::size_t body) {
  const auto is_its = [&](const AppliedForce::OnJoint& on) {
    return on.dof >= model.iv[body] && on.dof < model.iv[body] + model.dofs(body);
  };
  return std::ranges::any_of(actor.bodies,
                             [&](const AppliedForce::OnBody& on) { return on.body == body; }) ||
         std::ranges::any_of(actor.joints, is_its);
}

// Of six columns, what a joint of several velocities has of each; else as it lies.
void write_terms(JsonWriter& json, const Eigen::MatrixXd& value, bool by_columns) {
  if (value.cols() == 1)
    json.number_or_list({value.data(), value.data() + value.size()});
  else
    json.matrix(by_columns ? Eigen::MatrixXd(value.transpose()) : value);
}

void write_equations(JsonWriter& json, const Inspection& in, std::size_t body) {
  json.begin_array();
  for (const int pass : {1, 2, 3})
    for (const Equation& equation : equations_of(in, pass, body)) {
      const auto write_value_of = [&](const auto& of) {
        return [&] { write_terms(json, of.value, equation.by_columns); };
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

// What the equations of a body take from another one.
void write_neighbour(JsonWriter& json, const Inspection& in, std::size_t body, const char* is,
                     Names names) {
  std::vector<DisplayedQuantity> taken;
  for (const int pass : {1, 2, 3})
    for (DisplayedQuantity& shown : some_of(in, pass, body, names))
      taken.push_back(std::move(shown));
  const auto quantities = [&] { write_quantities(json, taken); };
  json.object({{"body", in.model.body_name[body]}, {"is", is}, {"quantities", quantities}});
}

void write_neighbours(JsonWriter& json, const Inspection& in, std::size_t body) {
  json.begin_array();
  if (in.parent(body) > 0) write_neighbour(json, in, in.parent(body), "parent", {"v", "a"});
  for (const std::size_t child : in.children(body))
    write_neighbour(json, in, child, "child", {"Xup", "Ia", "pa"});
  json.end_array();
}

// p'' = R (a_lin + w x v) + g, world axes: w.a is spatial, with gravity as a_0 = -g.
DisplayedQuantity origin_acceleration(const Inspection& in, std::size_t body) {
  const Vec3<double> a_B = classical_acceleration(in.w.v[body], in.w.a[body], {});
  return {{"acceleration", 3, Quantity::By::body, "acceleration of the link's origin", "m/s^2",
           "R (a_lin + w x v) + g, section 2.10"},
          "world axes",
          in.k.R_WB[body] * to_eigen(a_B) + to_eigen(in.model.gravity)};
}

// The whole call in its order: what a glance at each step tells.
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

}  // namespace

struct BodyInspector::Impl {
  SimulatePlan plan;
  GivenState given;  // of the start
  LabHand nobody;    // asked for nothing
  std::optional<InputOverride> lead;
  FrameHand hand;
  HeldPull pull;
  std::optional<SceneInspector> scene;

  explicit Impl(SimulatePlan of) : plan(std::move(of)), given(plan.input.robot.state) {
    SimulateInput& input = plan.input;
    input.robot.warnings.clear();  // of the scene: told when it was opened
    if (!input.scene) return;
    const double h = plan.run.step;
    lead.emplace(input.scene.get(), nobody, h);
    input.couplings =
        std::make_unique<SceneCouplings>(*input.scene, h, nullptr, in_place_of(*lead, hand));
    scene.emplace(input, h, std::vector<NamedSource>{{"mouse", &pull}}, plan.run.integrator);
  }

  Inspected look(const LabFrame& frame) {
    StateArchive memory = simulation_memory(frame.recorded.memory);
    if (scene) {
      hand.take(frame, plan.run.step);
      plan.input.couplings->forget_hands();
      pull.hold(frame.pull);
      return scene->look(&memory);
    }
    RobotInput& robot = plan.input.robot;
    State<double> x(robot.model);
    visit_state(memory, robot.model, x);
    robot.state = given;
    set_pose(robot, x);
    return inspect_robot(robot);
  }

  static InspectView view_of(const Inspection& in, const LabFrame& frame, std::size_t body,
                             const std::vector<std::string>& ledger) {
    InspectView view;
    view.bodies = {body};
    view.forces_alone = true;
    for (const AppliedForce& actor : in.actors)
      if (acts_on(actor, in.model, body)) view.forces.push_back(actor.source);
    const RecordedFrame& recorded = frame.recorded;
    for (std::size_t i = 0; i < std::min(recorded.rows.size(), recorded.works.size()); ++i)
      if (recorded.rows[i] < ledger.size())
        view.ledger.push_back(
            {EnergyRowKind::earlier, ledger[recorded.rows[i]], recorded.works[i]});
    return view;
  }

  void write(JsonWriter& json, const LabFrame& frame, const InspectRequest& question) {
    const Model<double>& model = plan.input.robot.model;
    if (model.parent.size() < 2) throw std::runtime_error("nothing moves here");
    const std::size_t body =
        question.body > 0 && question.body < model.parent.size() ? question.body : 1;
    Inspected found = look(frame);
    const Inspection in(model, found.x, std::move(found.actors), std::move(found.loops));
    static const std::vector<std::string> no_names;
    InspectView view = view_of(in, frame, body, question.ledger ? *question.ledger : no_names);
    view.warnings = std::move(found.warnings);
    warn_of_bad_numbers(in, view.warnings);
    std::vector<Check> checks;
    if (question.stands) {
      checks = run_checks(in);
      if (scene) checks.push_back(step_check(in, found.qdd_of_step));
    }
    json.members({{"body", body}, {"name", model.body_name[body]}});
    write_inspection(json, in, view, checks);
    write_equations(json.key("equations"), in, body);
    write_neighbours(json.key("neighbours"), in, body);
    if (question.stands) write_call(json.key("rows"), in);
  }
};

BodyInspector::BodyInspector(SimulatePlan plan) : impl_(std::make_unique<Impl>(std::move(plan))) {}
BodyInspector::~BodyInspector() = default;
BodyInspector::BodyInspector(BodyInspector&&) noexcept = default;
BodyInspector& BodyInspector::operator=(BodyInspector&&) noexcept = default;

std::string BodyInspector::message(const LabFrame& frame, const InspectRequest& question) {
  const auto text_with = [&](const auto& write) {
    return json_text([&](JsonWriter& json) {
      json.members({{"kind", "glass"},
                    {"scene", question.scene},
                    {"t", frame.recorded.t},
                    {"step", frame.recorded.step},
                    {"stands", question.stands}});
      write(json);
    });
  };
  try {
    return text_with([&](JsonWriter& json) { impl_->write(json, frame, question); });
  } catch (const std::exception& error) {
    const std::string warning = std::string("this frame cannot be looked into: ") + error.what();
    return text_with([&](JsonWriter& json) { json.key("warnings").texts({warning}); });
  }
}

}  // namespace twinarm
