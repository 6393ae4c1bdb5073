#include <fmt/format.h>

#include "app/inspect/report/inspect_output.h"
#include "app/support/text.h"
#include "solver/model/non_finite.h"

namespace twinarm {
namespace {

// The body's index; 0 and a diagnostic where there is none.
std::size_t index_of_body(const std::string& option, const std::string& name,
                          const std::string& others, const Model<double>& model,
                          DiagnosticList& faults) {
  const std::vector<std::string> names(model.body_name.begin() + 1, model.body_name.end());
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin()) + 1;
  faults.add(option, "there is no body '" + name + "'", others + name_remedy(name, names, "bodies"),
             "option.unknown-name");
  return 0;
}

// The name of a contact, "contact/A-B", matches all of its points, "contact/A-B/1".
bool matches(const std::string& name, const std::string& wanted) {
  const std::string rest = name.substr(std::min(wanted.size(), name.size()));
  const bool is_point = rest.size() > 1 && rest[0] == '/' &&
                        rest.find_first_not_of("0123456789", 1) == std::string::npos;
  return name == wanted || (is_point && name.starts_with(wanted));
}

void read_axes(const std::string& text, const Model<double>& model, InspectView& view,
               DiagnosticList& faults) {
  view.axes = text;
  if (text == "world") return;
  view.from.axes = text == "link" ? Viewpoint::Axes::own : Viewpoint::Axes::body;
  if (text != "link")
    view.from.axes_of =
        index_of_body("--axes", text, "give world, link or a body; ", model, faults);
}

void read_about(const std::string& text, const Model<double>& model, InspectView& view,
                DiagnosticList& faults) {
  using About = Viewpoint::About;
  view.about = text;
  if (text == "origin") return;
  if (text == "com") {
    view.from.about = About::own_com;
  } else if (text.find(',') != std::string::npos) {
    view.from.about = About::point;
    DiagnosticList of_numbers;
    const std::vector<double> numbers = parse_list("--about", text, of_numbers);
    if (numbers.size() == 3)
      view.from.point = Vector3(numbers[0], numbers[1], numbers[2]);
    else
      faults.add("--about", "'" + text + "' is not a point",
                 "give three world coordinates x,y,z [m]", "option.form");
  } else {
    view.from.about = About::body;
    view.from.about_body =
        index_of_body("--about", text, "give origin, com, x,y,z or a body; ", model, faults);
  }
}

}  // namespace

void read_passes(const InspectOptions& options, InspectView& view, DiagnosticList& faults) {
  static const std::vector<std::string> names{"1", "2", "3"};
  if (!options.passes.empty()) view.passes.clear();
  for (const std::string& pass : options.passes) {
    const auto found = std::ranges::find(names, pass);
    if (found == names.end())
      faults.add("--pass", "there is no pass '" + pass + "'",
                 "give 1 (velocities), 2 (inertias and forces) or 3 (accelerations)",
                 "option.choice");
    else
      view.passes.push_back(static_cast<int>(found - names.begin()) + 1);
  }
  std::ranges::sort(view.passes);
  view.passes.erase(std::unique(view.passes.begin(), view.passes.end()), view.passes.end());
}

void read_bodies(const InspectOptions& options, const Model<double>& model, InspectView& view,
                 DiagnosticList& faults) {
  std::vector<char> wanted(model.parent.size(), options.bodies.empty());
  for (const std::string& body : options.bodies)
    wanted[index_of_body("--body", body, "", model, faults)] = 1;
  for (std::size_t i = 1; i < wanted.size(); ++i)
    if (wanted[i]) view.bodies.push_back(i);
  read_axes(options.axes, model, view, faults);
  read_about(options.about, model, view, faults);
}

void read_forces(const InspectOptions& options, const std::vector<AppliedForce>& actors,
                 InspectView& view, DiagnosticList& faults) {
  std::vector<std::string> names;
  for (const AppliedForce& actor : actors) names.push_back(actor.source);
  view.forces_alone = !options.forces.empty();
  for (const std::string& wanted : options.forces) {
    bool found = false;
    for (const std::string& name : names)
      if (matches(name, wanted) || matches(name.substr(name.find('/') + 1), wanted)) {
        view.forces.push_back(name);
        found = true;
      }
    if (!found)
      faults.add("--force", "no force '" + wanted + "' acts in this state",
                 names.empty() ? "only gravity acts" : name_remedy(wanted, names, "forces"),
                 "option.unknown-name");
  }
}

Check step_check(const Inspection& in, const std::vector<double>& qdd_of_step) {
  constexpr double kTolerance = 1e-9;  // residual of the impulse solver
  Check check{"step", "accelerations of the scene's step", 0, kTolerance, ""};
  const Vector3 g = to_eigen(in.model.gravity);
  double size = std::max(g.norm(), 1e-300);
  for (const double qdd : qdd_of_step) size = std::max(size, std::abs(qdd));
  for (std::size_t i = 1; i < in.body_count(); ++i)
    for (std::size_t dof = in.model.iv[i]; dof < in.model.iv[i] + in.model.dofs(i); ++dof) {
      const double error = std::abs(in.w.qdd[dof] - qdd_of_step[dof]) / size;
      if (!(error <= check.error)) {
        check.error = std::isfinite(error) ? error : 1e300;
        check.worst = in.model.body_name[i];
      }
    }
  return check;
}

void warn_of_bad_numbers(const Inspection& in, std::vector<std::string>& warnings) {
  const NonFiniteField bad = first_bad_quantity(in.model, in.forces, in.w);
  if (bad.body == 0) return;
  const std::string pass = bad.pass == 0 ? "an input" : "of pass " + std::to_string(bad.pass);
  warnings.push_back(
      fmt::format("first non-finite quantity: '{}' of body '{}', {}; inspect an earlier instant",
                  bad.name, in.model.body_name[bad.body], pass));
}

}  // namespace twinarm
