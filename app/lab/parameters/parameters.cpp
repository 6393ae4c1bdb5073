#include "app/lab/parameters/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/lab/parameters/parameter_makers.h"
#include "app/scene/forces/add_contacts.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace knob_makers {

LabParameter slider(std::string path, const SliderRow& row, double value, std::string unit) {
  LabParameter knob;
  knob.path = std::move(path);
  knob.label = row.label;
  knob.number = value;
  knob.unit = std::move(unit);
  knob.form = row.scale == SliderRow::linear ? LabParameter::Form::linear : LabParameter::Form::log;
  knob.low = row.low;
  knob.high = row.high;
  knob.meaning = row.meaning;
  knob.restarts = row.restarts;
  return knob;
}

LabParameter choice(std::string path, std::string label, std::string value,
                    std::vector<std::string> choices, std::string meaning) {
  LabParameter knob;
  knob.path = std::move(path);
  knob.label = std::move(label);
  knob.text = std::move(value);
  knob.form = LabParameter::Form::choice;
  knob.choices = std::move(choices);
  knob.meaning = std::move(meaning);
  return knob;
}

}  // namespace knob_makers

namespace {

using namespace knob_makers;

LabParameter step_knob(const SimulatePlan& plan) {
  const double step = plan.run.step;
  const char* meaning =
      "Time from one step to the next. What a spring does within a step is not seen: too long a "
      "step, and it gains energy from nothing.";
  std::vector<std::string> steps;
  if (plan.input.scene) steps = steps_for_rates(plan.input.scene->description, step);
  LabParameter knob = steps.empty() ? slider("step", {"step h", 1e-5, 0.02, meaning}, step, "s")
                                    : choice("step", "step h", number_text(step), steps, meaning);
  knob.unit = "s";
  knob.group = "time";
  return knob;
}

// Those that carry what the scene has: contacts, and treatments that see the end of the step.
std::vector<std::string> integrators_for(const SceneModel* scene, Integrator now) {
  const bool constrained =
      scene && (scene->may_touch() || scene->description.contact == ContactMode::event);
  const bool implicit =
      scene && std::any_of(scene->couplings.begin(), scene->couplings.end(),
                           [](const SceneCoupling& c) { return c.needs_semi_implicit(); });
  std::vector<std::string> names;
  for (const IntegratorFacts& facts : all_integrators) {
    const bool fits = (!constrained || facts.integrator == Integrator::semi_implicit) &&
                      (!implicit || facts.implicit_force) &&
                      facts.integrator != Integrator::dopri5;  // its step is a tolerance
    if (fits || facts.integrator == now) names.emplace_back(facts.name);
  }
  return names;
}

LabParameter integrator_knob(const SimulatePlan& plan) {
  LabParameter knob =
      choice("integrator", "integrator", integrator_name(plan.run.integrator),
             integrators_for(plan.input.scene.get(), plan.run.integrator),
             "How a step goes from forces to the next state. Those that are not offered do not go "
             "with contacts or with implicit couplings.");
  knob.group = "time";
  knob.restarts = true;
  return knob;
}

LabParameter gravity_knob(const Vector3& gravity) {
  const SliderRow row{"gravity, up", -25, 25,
                      "Downward is negative: Earth -9.81, Moon -1.62, free flight 0.",
                      SliderRow::linear};
  LabParameter knob = slider("gravity[2]", row, gravity.z(), "m/s²");
  knob.group = "world";
  return knob;
}

LabParameter contact_knob(const SceneDescription& scene) {
  std::vector<std::string> names{"rigid", "compliant"};
  if (scene.contact == ContactMode::event) names.push_back("event");
  LabParameter knob = choice(
      "contact", "contact law", kContactModes[static_cast<std::size_t>(scene.contact)], names,
      "rigid: nothing goes into anything, impulses are solved for; compliant: a "
      "stiff spring with damping at each point.");
  knob.group = "world";
  knob.restarts = true;
  return knob;
}

const char* word_of(ParameterLimit::State state) {
  return state == ParameterLimit::State::ok     ? "ok"
         : state == ParameterLimit::State::near ? "near"
                                                : "beyond";
}

const char* word_of(LabParameter::Form form) {
  constexpr const char* kWords[] = {"log", "linear", "choice", "number"};
  return kWords[static_cast<std::size_t>(form)];
}

}  // namespace

std::string LabParameter::value() const {
  if (form == Form::choice) return text;
  return number ? number_text(*number) : "";
}

std::string LabParameter::change() const {
  const std::string now = value();
  return now.empty() ? "" : path + "=" + now;
}

void know_starts(const std::vector<LabParameter>& unchanged, std::vector<LabParameter>& knobs) {
  for (LabParameter& knob : knobs)
    for (const LabParameter& before : unchanged)
      if (before.path == knob.path) knob.start = before.value();
}

std::vector<LabParameter> knobs_of(const SimulatePlan& plan) {
  std::vector<LabParameter> knobs{step_knob(plan), integrator_knob(plan)};
  const SceneModel* scene = plan.input.scene.get();
  if (!scene) return knobs;
  knobs.push_back(gravity_knob(scene->description.gravity));
  if (scene->may_touch()) knobs.push_back(contact_knob(scene->description));
  add_couplings(scene->description, plan.run, knobs);
  add_masses(scene->description, knobs);
  if (scene->may_touch()) add_surfaces(*scene, knobs);
  return knobs;
}

void write_knobs(const std::vector<LabParameter>& knobs, JsonWriter& json) {
  json.list(knobs, [&](const LabParameter& knob) {
    json.begin_object();
    json.members({{"path", knob.path}, {"label", knob.label}, {"group", knob.group}});
    knob.form == LabParameter::Form::choice ? json.put("value", knob.text)
                                            : json.put("value", knob.number);
    if (knob.start) json.key("start").text(*knob.start);
    json.members({{"unit", knob.unit},
                  {"form", word_of(knob.form)},
                  {"low", knob.low},
                  {"high", knob.high},
                  {"choices", knob.choices},
                  {"meaning", knob.meaning}});
    if (knob.limit)
      json.key("limit").object({{"value", knob.limit->value},
                                {"words", knob.limit->words},
                                {"state", word_of(knob.limit->state)}});
    if (!knob.lag.empty()) json.put("lag", knob.lag);
    json.put("restarts", knob.restarts);
    json.end_object();
  });
}

}  // namespace twinarm
