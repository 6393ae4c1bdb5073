// Reading attributes of XML elements, with a fault (file, line, rule, remedy) for each bad one.
//
// A faulty value gives nothing; the caller goes on with a harmless one, so that all faults of a
// file are found in one go. Nothing made of harmless values is ever returned to the user.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "collision/import/robot/robot_description.h"
#include "collision/import/urdf/urdf.h"
#include "solver/support/diagnostics.h"

namespace tinyxml2 {
class XMLElement;
}

namespace twinarm {

class UrdfSource {
 public:
  UrdfSource(const std::filesystem::path& file, const RobotFileOptions& options);

  const std::filesystem::path& file() const { return file_; }  // absolute
  std::filesystem::path folder() const { return file_.parent_path(); }
  const RobotFileOptions& options() const { return options_; }

  void fault(int line, std::string where, std::string problem, std::string fix,
             std::string_view code);
  void fault(std::vector<Diagnostic> faults);
  void warn(int line, std::string where, std::string problem, std::string fix,
            std::string_view code);
  void warn(std::vector<Diagnostic> warnings);
  // All warnings of one `kind` become one: that of the first, with their number.
  void warn_once(const std::string& kind, int line, std::string where, std::string problem,
                 std::string fix, std::string_view code);

  // While an object of this type lives, faults are taken for warnings.
  class ErrorsAsWarnings {
   public:
    ErrorsAsWarnings(UrdfSource& source, bool soft) : source_(source), before_(source.soft_) {
      source.soft_ = soft;
    }
    ~ErrorsAsWarnings() { source_.soft_ = before_; }
    ErrorsAsWarnings(const ErrorsAsWarnings&) = delete;
    ErrorsAsWarnings& operator=(const ErrorsAsWarnings&) = delete;

   private:
    UrdfSource& source_;
    bool before_;
  };
  std::size_t softened() const { return softened_; }  // faults that became warnings so far

  // Throws InputError with all faults, in the order of their lines; returns if there is none.
  void check();
  std::vector<Diagnostic> warnings() const;  // in the order of their lines

  // `fallback` is taken where the attribute is missing; without one, a missing attribute is a
  // fault.
  std::optional<double> number(const tinyxml2::XMLElement& element, const char* attribute,
                               const std::string& where,
                               std::optional<double> fallback = std::nullopt);
  // The same, but "inf" and "-inf" are numbers too.
  std::optional<double> bound(const tinyxml2::XMLElement& element, const char* attribute,
                              const std::string& where, double fallback);
  // A number that must be greater than zero.
  std::optional<double> positive(const tinyxml2::XMLElement& element, const char* attribute,
                                 const std::string& where);
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
  // More than one of what there can be only one of is a fault: which would count?
  void at_most_one(const tinyxml2::XMLElement& parent, const char* name, const std::string& where);

 private:
  struct Kind {
    Diagnostic first;
    std::size_t count = 0;
  };

  std::filesystem::path file_;
  RobotFileOptions options_;
  std::vector<Diagnostic> faults_, warnings_;
  std::map<std::string, Kind> kinds_;
  bool soft_ = false;
  std::size_t softened_ = 0;
};

}  // namespace twinarm
