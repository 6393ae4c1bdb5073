// Reads values of a TOML table. Each invalid value is reported as a Diagnostic and replaced by a
// default, and reading continues (as in urdf_xml.h).
#pragma once

#include <toml++/toml.h>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "collision/import/robot/robot_description.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

class TomlSource {
 public:
  TomlSource(std::string file, std::vector<Diagnostic>& faults)
      : file_(std::move(file)), faults_(faults) {}

  static int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }
  void fault(int line, std::string where, std::string problem, std::string fix) {
    faults_.push_back(
        {file_, line, std::move(where), std::move(problem), std::move(fix), "recipe.value"});
  }

  // Reports unknown keys.
  void only_keys(const toml::table& table, const std::string& where,
                 std::initializer_list<std::string_view> keys);

  // `fallback` is used if the key is missing; without it, a missing key is an error.
  double number(const toml::table& table, std::string_view key, const std::string& where,
                std::optional<double> fallback = std::nullopt);
  std::string text(const toml::table& table, std::string_view key, const std::string& where,
                   std::optional<std::string> fallback = std::nullopt);
  // Empty, with an error, if the key is missing or is not a list of `count` finite numbers.
  std::optional<std::vector<double>> numbers(const toml::table& table, std::string_view key,
                                             const std::string& where, std::size_t count);
  std::optional<Vector3> vector3(const toml::table& table, std::string_view key,
                                 const std::string& where);
  std::vector<std::string> texts(const toml::table& table, std::string_view key,
                                 const std::string& where);
  // The tables of [[key]]; empty without the key.
  std::vector<const toml::table*> tables(const toml::table& table, std::string_view key,
                                         const std::string& where);
  // [key]; nullptr without the key.
  const toml::table* table(const toml::table& parent, std::string_view key,
                           const std::string& where);

 private:
  std::string file_;
  std::vector<Diagnostic>& faults_;
};

}  // namespace twinarm
