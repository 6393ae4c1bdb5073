// Parameters of couplings: type, discretization, gains, rate, and those of the target.

#include "app/lab/parameters/parameter_makers.h"
#include "app/scene/read/read_scene.h"

namespace twinarm::parameter_makers {
namespace {

using CouplingKind = CouplingSpec::Type;

// Null: the link has no joint of its own. Required by laws that act on joints.
const JointDescription* own_joint(const SceneDescription& scene, const CouplingDescription& c) {
  for (const RobotInScene& robot : scene.robots)
    if (robot.name == c.robot) return twinarm::own_joint(robot.description, c.link);
  return nullptr;
}

bool is_slide(const SceneDescription& scene, const CouplingDescription& c) {
  const JointDescription* joint = own_joint(scene, c);
  return c.measure == SpringSpace::joint && joint &&
         joint->type == JointDescription::Type::prismatic;
}

// A coupling at a point can change to one of the orientation; the reverse needs a point in the
// file.
std::vector<std::string> types_for(const SceneDescription& scene, const CouplingDescription& c,
                                   bool implicit_fits) {
  const CouplingFacts& now = facts_of(c.law, c.printed);
  std::vector<std::string> names;
  for (const CouplingFacts& facts : all_couplings) {
    const bool is_now = facts.type == c.law && facts.printed == c.printed;
    const bool is_implicit = facts.discretizations == CouplingFacts::Discretizations::own ||
                             facts.gains == CouplingFacts::Gains::reference;
    const bool fits = facts.gains != CouplingFacts::Gains::none &&
                      (now.at_point || !facts.at_point) &&
                      (!facts.at_joint || own_joint(scene, c)) && (implicit_fits || !is_implicit);
    if (is_now || fits) names.emplace_back(facts.name);
  }
  return names;
}

struct CouplingParameters {
  const SceneDescription& scene;
  const RunPlan& run;
  std::size_t index;
  std::vector<LabParameter>& parameters;
  const CouplingDescription& c = scene.couplings[index];
  const CouplingFacts& facts = facts_of(c.law, c.printed);
  bool implicit_fits =
      facts_of(run.integrator).implicit_force && scene.contact != ContactMode::event;

  void add() {
    if (!c.soft_limits && facts.gains != CouplingFacts::Gains::none) add_type();
    add_discretization();
    for (const CouplingKey& row : coupling_keys())
      if (!row.of_target) add_slider(row);
    add_time();
    for (const CouplingKey& row : coupling_keys())
      if (row.of_target && row.of_target(c.target.kind)) add_slider(row);
  }

  LabParameter& put(const char* key, LabParameter parameter) {
    parameter.path = item("coupling", index, key);
    parameter.group = c.name;
    parameter.coupling = static_cast<int>(index);
    parameter.key = key;
    parameters.push_back(std::move(parameter));
    return parameters.back();
  }
  void add_slider(const CouplingKey& row) {
    if (!row.slider.label || !row.has(facts)) return;
    const bool turns = c.type == CouplingDescription::Type::torsional && !is_slide(scene, c);
    LabParameter& parameter =
        put(row.key, slider("", row.slider, row.value(c), row.unit_of(turns)));
    if (!turns || row.turning_low == 0) return;
    parameter.low = row.turning_low;
    parameter.high = row.turning_high;
  }

  void add_type() {
    const auto types = types_for(scene, c, implicit_fits);
    if (types.size() > 1)
      put("type", choice("", "type", facts.name, types, "Coupled quantity and coupling law."))
          .resets_state = true;
    if (c.law == CouplingKind::torsional && !c.printed && own_joint(scene, c))
      put("measure", choice("", "measure", c.measure == SpringSpace::world ? "world" : "joint",
                            {"world", "joint"},
                            "The link's orientation in the world, or the angle of its own joint."))
          .resets_state = true;
  }

  void add_discretization() {
    if (c.soft_limits || c.rate > 0 || facts.discretizations != CouplingFacts::Discretizations::all)
      return;
    if (!implicit_fits) return;
    put("discretization",
        choice("", "discretization", name_of(c.discretization),
               {"explicit", "semi-implicit", "implicit"},
               "Evaluation of the spring-damper. explicit: at the start of the step; "
               "semi-implicit: damper at its end; implicit: spring too, stable for any stiffness."))
        .resets_state = true;
  }

  void add_time() {
    // A held force is evaluated at the start of a step, as explicit ones are.
    const bool is_explicit = c.discretization == Discretization::explicit_ || c.printed;
    if (facts.can_hold && is_explicit && !run.is_adaptive()) {
      LabParameter parameter =
          choice("", "update rate", c.rate > 0 ? number_text(c.rate) : "",
                 rates_for_step(c.rate, run.step),
                 "Rate of force evaluations; the force is held in between. Empty: every step.");
      parameter.unit = "Hz";
      parameter.resets_state = true;
      put("rate", std::move(parameter));
    }
    if (coupling_key("damper").has(facts) &&
        facts.discretizations != CouplingFacts::Discretizations::own && !c.soft_limits)
      put("damper", choice("", "damper", c.absolute_damper ? "absolute" : "relative",
                           {"relative", "absolute"},
                           "Damping of the velocity relative to the target, or of the link's "
                           "absolute velocity, which increases the tracking error."));
  }
};

// One slider for all couplings with the same value.
void add_common(const SceneDescription& scene, std::vector<LabParameter>& parameters) {
  const auto& all = scene.couplings;
  if (all.size() < 2) return;
  const auto agree = [&](auto value) {
    return std::ranges::all_of(all, [&](const CouplingDescription& c) {
      return c.law == all[0].law && c.printed == all[0].printed && c.measure == all[0].measure &&
             is_slide(scene, c) == is_slide(scene, all[0]) && !c.soft_limits &&
             c.rate == all[0].rate && value(c) == value(all[0]);
    });
  };
  for (const CouplingKey& row : coupling_keys()) {
    if (!row.turning_unit) continue;
    const auto one = std::ranges::find_if(parameters, [&](const LabParameter& parameter) {
      return parameter.coupling == 0 && parameter.key == row.key;
    });
    if (one == parameters.end() ||
        !agree([&](const CouplingDescription& c) { return row.value(c); }))
      continue;
    LabParameter parameter = *one;
    parameter.path = std::string("coupling.") + row.key;
    parameter.coupling = -1;
    parameter.group = "all couplings";
    parameters.push_back(std::move(parameter));
  }
}

}  // namespace

std::vector<std::string> steps_for_rates(const SceneDescription& scene, double step) {
  std::vector<double> rates;
  for (const CouplingDescription& c : scene.couplings)
    if (c.rate > 0) rates.push_back(c.rate);
  if (rates.empty()) return {};
  const double max_rate = std::ranges::max(rates);
  const auto fits = [&](double h) {
    return std::ranges::all_of(rates, [&](double rate) {
      const double steps = 1 / (rate * h);
      return std::round(steps) >= 1 && std::abs(steps - std::round(steps)) < 1e-9 * steps;
    });
  };
  std::vector<std::string> texts{number_text(step)};
  for (const int part : {1, 2, 4, 5, 10, 20, 50, 100}) {
    const double h = 1 / (max_rate * part);
    if (h >= 1e-5 && std::abs(h - step) > 1e-9 * step && fits(h)) texts.push_back(number_text(h));
  }
  return texts;
}

std::vector<std::string> rates_for_step(double rate, double step) {
  std::vector<std::string> texts;
  if (rate > 0) texts.push_back(number_text(rate));
  for (const int steps : {1, 2, 4, 5, 10, 20, 50, 100}) {
    const double other = 1 / (steps * step);
    if (!(std::abs(other - rate) < 1e-9 * rate)) texts.push_back(number_text(other));
  }
  return texts;
}

void add_couplings(const SceneDescription& scene, const RunPlan& run,
                   std::vector<LabParameter>& parameters) {
  std::vector<LabParameter> own;
  for (std::size_t i = 0; i < scene.couplings.size(); ++i)
    CouplingParameters{scene, run, i, own}.add();
  std::vector<LabParameter> common = own;
  add_common(scene, common);
  parameters.insert(parameters.end(), common.begin() + static_cast<std::ptrdiff_t>(own.size()),
                    common.end());
  parameters.insert(parameters.end(), own.begin(), own.end());
}

}  // namespace twinarm::parameter_makers
