// Reads attributes of XML elements. Each invalid value is reported as a Diagnostic, and the caller
// continues with a default, so that all errors of a file are found at once; check() then throws.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "collision/import/robot/robot_check.h"
#include "collision/import/urdf/urdf.h"
#include "collision/import/urdf/xml_element.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

class UrdfSource : RobotCheck {
 public:
  UrdfSource(const std::filesystem::path& file, const RobotFileOptions& options);

  const std::filesystem::path& file() const { return RobotCheck::file; }  // absolute
  std::filesystem::path folder() const { return file().parent_path(); }
  const RobotFileOptions& options() const { return options_; }

  void fault(int line, std::string where, std::string problem, std::string fix,
             std::string_view code);
  using RobotCheck::warn;
  void add(RobotCheck found);
  // All warnings of one `kind` become one: the first, with their number.
  void warn_once(const std::string& kind, int line, std::string where, std::string problem,
                 std::string fix, std::string_view code);

  // During the lifetime of this object, errors are warnings.
  class ErrorsAsWarnings {
   public:
    ErrorsAsWarnings(UrdfSource& source, bool downgrade)
        : source_(source), before_(source.downgrade_) {
      source.downgrade_ = downgrade;
    }
    ~ErrorsAsWarnings() { source_.downgrade_ = before_; }
    ErrorsAsWarnings(const ErrorsAsWarnings&) = delete;
    ErrorsAsWarnings& operator=(const ErrorsAsWarnings&) = delete;

   private:
    UrdfSource& source_;
    bool before_;
  };
  std::size_t downgraded() const { return downgraded_; }  // errors that became warnings so far
  // Throws InputError with all errors in the order of their lines, if there are any.
  void check();
  std::vector<Diagnostic> all_warnings() const;  // in the order of their lines

  // `fallback` is used if the attribute is missing; without it, a missing attribute is an error.
  std::optional<double> number(const XmlElement& element, const char* attribute,
                               const std::string& where,
                               std::optional<double> fallback = std::nullopt);
  // Also accepts "inf" and "-inf".
  std::optional<double> bound(const XmlElement& element, const char* attribute,
                              const std::string& where, double fallback);
  // A number > 0.
  std::optional<double> positive(const XmlElement& element, const char* attribute,
                                 const std::string& where);
  std::optional<std::vector<double>> numbers(const XmlElement& element, const char* attribute,
                                             const std::string& where, std::size_t count);
  std::optional<Vector3> vector3(const XmlElement& element, const char* attribute,
                                 const std::string& where,
                                 std::optional<Vector3> fallback = std::nullopt);
  // Empty, with an error, if the attribute is missing or empty.
  std::string text(const XmlElement& element, const char* attribute, const std::string& where);
  // The <origin> in `parent`; default: identity.
  Origin origin(const XmlElement& parent, const std::string& where);
  // More than one child of this name is an error.
  void at_most_one(const XmlElement& parent, const char* name, const std::string& where);

 private:
  struct Kind {
    Diagnostic first;
    std::size_t count = 0;
  };

  RobotFileOptions options_;
  std::map<std::string, Kind> kinds_;
  bool downgrade_ = false;
  std::size_t downgraded_ = 0;
};

}  // namespace twinarm
