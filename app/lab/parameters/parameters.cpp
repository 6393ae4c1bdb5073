
#include <unordered_map>

#include "app/lab/parameters/parameter_makers.h"

namespace twinarm {
namespace parameter_makers {

LabParameter slider(std::string path, const SliderRow& row, double value, std::string unit,
                    std::string group) {
  LabParameter parameter;
  parameter.path = std::move(path);
  parameter.label = row.label;
  parameter.group = std::move(group);
  parameter.number = value;
  parameter.unit = std::move(unit);
  parameter.form = row.scale == SliderRow::linear ? "linear" : "log";
  parameter.low = row.low;
  parameter.high = row.high;
  parameter.description = row.meaning;
  parameter.resets_state = row.restarts;
  return parameter;
}

LabParameter choice(std::string path, std::string label, std::string value,
                    std::vector<std::string> choices, std::string description) {
  LabParameter parameter;
  parameter.path = std::move(path);
  parameter.label = std::move(label);
  parameter.text = std::move(value);
  parameter.form = "choice";
  parameter.choices = std::move(choices);
  parameter.description = std::move(description);
  return parameter;
}

}  // namespace parameter_makers

namespace {

using namespace parameter_makers;

LabParameter step_parameter(const SimulatePlan& plan) {
  const double step = plan.run.step;
  const char* meaning = "Time step h. Too large a step makes stiff springs unstable.";
  std::vector<std::string> steps;
  if (plan.input.scene) steps = steps_for_rates(plan.input.scene->description, step);
  LabParameter parameter = steps.empty()
                               ? slider("step", {"step h", 1e-5, 0.02, meaning}, step, "s")
                               : choice("step", "step h", number_text(step), steps, meaning);
  parameter.unit = "s";
  return parameter;
}

// Integrators that support the scene's contacts and implicit couplings, and the present one.
std::vector<std::string> integrators_for(const SceneModel* scene, Integrator now) {
  const bool constrained =
      scene && (scene->may_touch() || scene->description.contact == ContactMode::event);
  const bool implicit =
      scene && std::ranges::any_of(scene->couplings, &SceneCoupling::needs_semi_implicit);
  std::vector<std::string> names;
  for (const IntegratorFacts& facts : all_integrators) {
    const bool fits = (!constrained || facts.integrator == Integrator::semi_implicit) &&
                      (!implicit || facts.implicit_force) &&
                      facts.integrator != Integrator::dopri5;  // it has a tolerance, no fixed step
    if (fits || facts.integrator == now) names.emplace_back(facts.name);
  }
  return names;
}

LabParameter integrator_parameter(const SimulatePlan& plan) {
  LabParameter parameter = choice("integrator", "integrator", integrator_name(plan.run.integrator),
                                  integrators_for(plan.input.scene.get(), plan.run.integrator),
                                  "Rule by which a step is taken. Integrators that do not support "
                                  "the scene's contacts or implicit couplings are not listed.");
  parameter.resets_state = true;
  return parameter;
}

LabParameter gravity_parameter(const Vector3& gravity) {
  const SliderRow row{"gravity along z", -25, 25,
                      "Gravitational acceleration along z: Earth -9.81, Moon -1.62, none 0.",
                      SliderRow::linear};
  return slider("gravity[2]", row, gravity.z(), "m/s²");
}

LabParameter contact_parameter(const SceneDescription& scene) {
  std::vector<std::string> names{"rigid", "compliant"};
  if (scene.contact == ContactMode::event) names.push_back("event");
  LabParameter parameter = choice("contact", "contact law",
                                  kContactModes[static_cast<std::size_t>(scene.contact)], names,
                                  "rigid: unilateral constraints, solved for impulses; compliant: "
                                  "a spring-damper at each contact point.");
  parameter.resets_state = true;
  return parameter;
}

LabParameter budget_parameter(const SceneDescription& scene) {
  return slider("budget",
                {"contact budget", 1e8, 1e13,
                 "Floating-point operations of the contact solver per simulated second; "
                 "1e9 is real time for heaps, with small errors."},
                scene.budget > 0 ? scene.budget : 1e13, "1/s");
}

}  // namespace

std::string LabParameter::value() const {
  if (form == "choice") return text;
  return number ? number_text(*number) : "";
}

void set_initial_values(const std::vector<LabParameter>& unchanged,
                        std::vector<LabParameter>& parameters) {
  std::unordered_map<std::string_view, const LabParameter*> before;
  for (const LabParameter& parameter : unchanged) before[parameter.path] = &parameter;
  for (LabParameter& parameter : parameters)
    if (const auto found = before.find(parameter.path); found != before.end())
      parameter.initial = found->second->value();
}

std::vector<LabParameter> parameters_of(const SimulatePlan& plan) {
  std::vector<LabParameter> parameters{step_parameter(plan), integrator_parameter(plan)};
  const SceneModel* scene = plan.input.scene.get();
  if (scene) parameters.push_back(gravity_parameter(scene->description.gravity));
  if (scene && scene->may_touch()) {
    parameters.push_back(contact_parameter(scene->description));
    parameters.push_back(budget_parameter(scene->description));
  }
  for (std::size_t i = 0; i < parameters.size(); ++i)
    parameters[i].group = i < 2 ? "time" : "world";
  if (!scene) return parameters;
  add_couplings(scene->description, plan.run, parameters);
  add_joints(*scene, parameters);
  add_masses(scene->description, parameters);
  if (scene->may_touch()) add_surfaces(*scene, parameters);
  return parameters;
}

void write_parameters(const std::vector<LabParameter>& parameters, JsonWriter& json) {
  json.list(parameters, [&](const LabParameter& parameter) {
    json.begin_object();
    json.members(
        {{"path", parameter.path}, {"label", parameter.label}, {"group", parameter.group}});
    parameter.form == "choice" ? json.put("value", parameter.text)
                               : json.put("value", parameter.number);
    if (parameter.initial) json.key("start").text(*parameter.initial);
    json.members({{"unit", parameter.unit},
                  {"form", parameter.form},
                  {"low", parameter.low},
                  {"high", parameter.high},
                  {"choices", parameter.choices},
                  {"meaning", parameter.description}});
    if (parameter.limit)
      json.key("limit").object({{"value", parameter.limit->value},
                                {"words", parameter.limit->words},
                                {"state", parameter.limit->state}});
    if (!parameter.tracking_error.empty()) json.put("tracking_error", parameter.tracking_error);
    json.members({{"restarts", parameter.resets_state}, {"folded", parameter.is_folded}});
    json.end_object();
  });
}

}  // namespace twinarm
