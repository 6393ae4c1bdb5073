#include "collision/import/urdf/urdf_xml.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>

#include "solver/support/number_text.h"
#include "solver/support/text.h"

namespace twinarm {

namespace {

std::string tag(const XmlElement& element, const char* attribute) {
  return "<" + element.name + " " + attribute + "=\"...\">";
}

bool is_xacro(const std::string& value) {
  return value.find("${") != std::string::npos || value.find("$(") != std::string::npos;
}
std::string fix_for(const std::string& value) {
  if (is_xacro(value))
    return "this is a xacro file: expand it first (xacro robot.urdf.xacro > robot.urdf)";
  if (value.find(',') != std::string::npos)
    return "use a decimal point, and spaces between numbers";
  return "give finite decimal numbers in SI units";
}

std::string shortened(const std::string& value) {
  constexpr std::size_t kMaxLength = 80;
  return value.size() <= kMaxLength ? value : value.substr(0, kMaxLength) + "...";
}

}  // namespace

UrdfSource::UrdfSource(const std::filesystem::path& file, const RobotFileOptions& options)
    : RobotCheck{std::filesystem::absolute(file).lexically_normal(), {}, {}}, options_(options) {}

void UrdfSource::fault(int line, std::string where, std::string problem, std::string fix,
                       std::string_view code) {
  if (downgrade_) ++downgraded_;
  add_diagnostic(downgrade_ ? warnings : faults, {file().string(), line, std::move(where),
                                                  std::move(problem), std::move(fix), code});
}

void UrdfSource::add(RobotCheck found) {
  for (Diagnostic& fault : found.faults) add_diagnostic(faults, std::move(fault));
  for (Diagnostic& warning : found.warnings) add_diagnostic(warnings, std::move(warning));
}

void UrdfSource::warn_once(const std::string& kind, int line, std::string where,
                           std::string problem, std::string fix, std::string_view code) {
  Kind& entry = kinds_[kind];
  if (entry.count++ == 0)
    entry.first = {file().string(),    line,           std::move(where),
                   std::move(problem), std::move(fix), code};
}

void UrdfSource::check() {
  throw_in_line_order(faults);
}

std::vector<Diagnostic> UrdfSource::all_warnings() const {
  std::vector<Diagnostic> all = warnings;
  for (const auto& [name, kind] : kinds_) {
    all.push_back(kind.first);
    if (kind.count > 1) all.back().problem += " (the first of " + std::to_string(kind.count) + ")";
  }
  std::ranges::stable_sort(all, {}, &Diagnostic::line);
  return all;
}

std::optional<std::vector<double>> UrdfSource::numbers(const XmlElement& element,
                                                       const char* attribute,
                                                       const std::string& where,
                                                       std::size_t count) {
  const XmlAttribute* found = element.find(attribute);
  if (!found) {
    fault(element.line, where, tag(element, attribute) + " is missing",
          "give it " + std::to_string(count) + (count == 1 ? " number" : " numbers"),
          "urdf.attribute-missing");
    return std::nullopt;
  }
  const std::string value = found->value;
  auto numbers = parse_numbers(value);
  if (!numbers || numbers->size() != count) {
    fault(found->line, where,
          tag(element, attribute) + " is '" + shortened(value) + "', must be " +
              std::to_string(count) + (count == 1 ? " finite number" : " finite numbers"),
          fix_for(value), is_xacro(value) ? "urdf.xacro" : "urdf.number");
    return std::nullopt;
  }
  return numbers;
}

std::optional<double> UrdfSource::number(const XmlElement& element, const char* attribute,
                                         const std::string& where, std::optional<double> fallback) {
  if (fallback && !element.find(attribute)) return fallback;
  const auto values = numbers(element, attribute, where, 1);
  return values ? std::optional((*values)[0]) : std::nullopt;
}

std::optional<double> UrdfSource::bound(const XmlElement& element, const char* attribute,
                                        const std::string& where, double fallback) {
  const char* value = element.value(attribute);
  const std::string text = lower_case(value ? value : "");
  if (text == "inf" || text == "+inf") return std::numeric_limits<double>::infinity();
  if (text == "-inf") return -std::numeric_limits<double>::infinity();
  return number(element, attribute, where, fallback);
}

std::optional<double> UrdfSource::positive(const XmlElement& element, const char* attribute,
                                           const std::string& where) {
  const auto value = number(element, attribute, where);
  if (!value || *value > 0) return value;
  fault(element.find(attribute)->line, where,
        tag(element, attribute) + " is " + number_text(*value) + ", must be positive",
        "give a length in metres", "urdf.number");
  return std::nullopt;
}

std::optional<Vector3> UrdfSource::vector3(const XmlElement& element, const char* attribute,
                                           const std::string& where,
                                           std::optional<Vector3> fallback) {
  if (fallback && !element.find(attribute)) return fallback;
  const auto values = numbers(element, attribute, where, 3);
  if (!values) return std::nullopt;
  return Vector3((*values)[0], (*values)[1], (*values)[2]);
}

std::string UrdfSource::text(const XmlElement& element, const char* attribute,
                             const std::string& where) {
  const char* value = element.value(attribute);
  if (value && *value) return value;
  fault(element.line, where, tag(element, attribute) + (value ? " is empty" : " is missing"),
        "give a value", "urdf.attribute-missing");
  return {};
}

Origin UrdfSource::origin(const XmlElement& parent, const std::string& where) {
  at_most_one(parent, "origin", where);
  const XmlElement* element = parent.child("origin");
  if (!element) return {};
  Origin origin;
  origin.xyz = vector3(*element, "xyz", where, Vector3(Vector3::Zero())).value_or(origin.xyz);
  origin.rpy = vector3(*element, "rpy", where, Vector3(Vector3::Zero())).value_or(origin.rpy);
  constexpr double kMaxAngle = 6.3;  // [rad]
  if (origin.rpy.lpNorm<Eigen::Infinity>() > kMaxAngle)
    warn(element->line, where,
         "rpy = '" + std::string(element->value("rpy")) + "' is more than one revolution",
         "give angles in radians: 90 degrees are 1.5707963267948966", "urdf.full-turn");
  if (!element->find("quat_xyzw")) return origin;
  if (element->find("rpy"))
    fault(element->line, where, "its <origin> has both rpy and quat_xyzw", "give one",
          "urdf.two-rotations");
  if (const auto q = numbers(*element, "quat_xyzw", where, 4)) {
    const Eigen::Quaterniond rotation((*q)[3], (*q)[0], (*q)[1], (*q)[2]);
    if (rotation.norm() > 1e-9)
      origin.turn_to(rotation.normalized().toRotationMatrix());
    else
      fault(element->line, where, "its quat_xyzw is zero", "give a unit quaternion", "urdf.number");
  }
  return origin;
}

void UrdfSource::at_most_one(const XmlElement& parent, const char* name, const std::string& where) {
  const std::vector<const XmlElement*> all = parent.all(name);
  if (all.size() > 1)
    fault(all[1]->line, where, std::string("more than one <") + name + ">",
          std::string("give one <") + name + ">", "urdf.twice");
}

}  // namespace twinarm
