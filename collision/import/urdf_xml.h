// Reading attributes of XML elements, with a fault (file, line, rule, remedy) for each bad one.
//
// A faulty value gives nothing; the caller goes on with a harmless one, so that all faults of a
// file are found in one go. Nothing made of harmless values is ever returned to the user.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "collision/import/robot_description.h"
#include "solver/fault.h"

namespace tinyxml2 {
class XMLElement;
}

namespace twinarm {

class UrdfSource {
 public:
  explicit UrdfSource(const std::filesystem::path& file);  // made absolute

  const std::filesystem::path& file() const { return file_; }
  std::filesystem::path folder() const { return file_.parent_path(); }

  void fault(int line, std::string where, std::string rule, std::string remedy);
  void fault(std::vector<Fault> faults);
  // Throws InputError with all faults, in the order of their lines; returns if there is none.
  void check();

  // `fallback` is taken where the attribute is missing; without one, a missing attribute is a
  // fault.
  std::optional<double> number(const tinyxml2::XMLElement& element, const char* attribute,
                               const std::string& where,
                               std::optional<double> fallback = std::nullopt);
  // The same, and the number must be greater than zero.
  std::optional<double> positive(const tinyxml2::XMLElement& element, const char* attribute,
                                 const std::string& where,
                                 std::optional<double> fallback = std::nullopt);
  std::optional<std::vector<double>> numbers(const tinyxml2::XMLElement& element,
                                             const char* attribute, const std::string& where,
                                             std::size_t count);
  // Three numbers; `fallback` as above.
  std::optional<Vector3> vector3(const tinyxml2::XMLElement& element, const char* attribute,
                                 const std::string& where,
                                 std::optional<Vector3> fallback = std::nullopt);
  // Empty, with a fault, where the attribute is missing or empty.
  std::string text(const tinyxml2::XMLElement& element, const char* attribute,
                   const std::string& where);
  // The <origin> inside `parent`; identity where there is none.
  Origin origin(const tinyxml2::XMLElement& parent, const std::string& where);

 private:
  std::filesystem::path file_;
  std::vector<Fault> faults_;
};

}  // namespace twinarm
