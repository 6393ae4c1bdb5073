// Reading attributes of XML elements, with a fault for each bad one.
#include "collision/import/urdf_xml.h"

#include <tinyxml2.h>

#include "collision/import/number_text.h"
#include "collision/import/robot_check.h"

namespace twinarm {

using tinyxml2::XMLElement;

namespace {

std::string tag(const XMLElement& element, const char* attribute) {
  return std::string("<") + element.Name() + " " + attribute + "=\"...\">";
}

// "'x' is not a number"; a value that a macro should have filled is told as such.
std::string remedy_for(const std::string& value) {
  if (value.find("${") != std::string::npos || value.find("$(") != std::string::npos)
    return "this is a xacro file: expand it first (xacro robot.urdf.xacro > robot.urdf)";
  return "give finite decimal numbers in SI units";
}

}  // namespace

UrdfSource::UrdfSource(const std::filesystem::path& file)
    : file_(std::filesystem::absolute(file).lexically_normal()) {}

void UrdfSource::fault(int line, std::string where, std::string rule, std::string remedy) {
  faults_.push_back({file_.string(), line, std::move(where), std::move(rule), std::move(remedy)});
}

void UrdfSource::fault(std::vector<Fault> faults) {
  faults_.insert(faults_.end(), faults.begin(), faults.end());
}

void UrdfSource::check() {
  throw_in_line_order(faults_);
}

std::optional<std::vector<double>> UrdfSource::numbers(const XMLElement& element,
                                                       const char* attribute,
                                                       const std::string& where,
                                                       std::size_t count) {
  const tinyxml2::XMLAttribute* found = element.FindAttribute(attribute);
  if (!found) {
    fault(element.GetLineNum(), where, tag(element, attribute) + " is missing",
          "give it " + std::to_string(count) + (count == 1 ? " number" : " numbers"));
    return std::nullopt;
  }
  const std::string value = found->Value();
  auto numbers = parse_numbers(value);
  if (!numbers || numbers->size() != count) {
    fault(found->GetLineNum(), where,
          tag(element, attribute) + " is '" + value + "', must be " + std::to_string(count) +
              (count == 1 ? " finite number" : " finite numbers"),
          remedy_for(value));
    return std::nullopt;
  }
  return numbers;
}

std::optional<double> UrdfSource::number(const XMLElement& element, const char* attribute,
                                         const std::string& where, std::optional<double> fallback) {
  if (fallback && !element.FindAttribute(attribute)) return fallback;
  const auto values = numbers(element, attribute, where, 1);
  return values ? std::optional((*values)[0]) : std::nullopt;
}

std::optional<double> UrdfSource::positive(const XMLElement& element, const char* attribute,
                                           const std::string& where,
                                           std::optional<double> fallback) {
  const auto value = number(element, attribute, where, fallback);
  if (!value || *value > 0) return value;
  fault(element.FindAttribute(attribute)->GetLineNum(), where,
        tag(element, attribute) + " is " + number_text(*value) + ", must be positive",
        "give a length in metres");
  return std::nullopt;
}

std::optional<Vector3> UrdfSource::vector3(const XMLElement& element, const char* attribute,
                                           const std::string& where,
                                           std::optional<Vector3> fallback) {
  if (fallback && !element.FindAttribute(attribute)) return fallback;
  const auto values = numbers(element, attribute, where, 3);
  if (!values) return std::nullopt;
  return Vector3((*values)[0], (*values)[1], (*values)[2]);
}

std::string UrdfSource::text(const XMLElement& element, const char* attribute,
                             const std::string& where) {
  const char* value = element.Attribute(attribute);
  if (value && *value) return value;
  fault(element.GetLineNum(), where,
        tag(element, attribute) + (value ? " is empty" : " is missing"), "give it");
  return {};
}

Origin UrdfSource::origin(const XMLElement& parent, const std::string& where) {
  const XMLElement* element = parent.FirstChildElement("origin");
  if (!element) return {};
  Origin origin;
  origin.xyz = vector3(*element, "xyz", where, Vector3(Vector3::Zero())).value_or(origin.xyz);
  origin.rpy = vector3(*element, "rpy", where, Vector3(Vector3::Zero())).value_or(origin.rpy);
  return origin;
}

}  // namespace twinarm
