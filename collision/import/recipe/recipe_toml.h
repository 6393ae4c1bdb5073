// Reading values of a TOML table, with a fault (file, line, rule, remedy) for each bad one.
//
// As in urdf_xml.h: a faulty value is told and replaced by a harmless one, and reading goes on.
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

  // A misspelt key would else be left out in silence.
  void only_keys(const toml::table& table, const std::string& where,
                 std::initializer_list<std::string_view> keys);

  // `fallback` is taken where the key is missing; without one, a missing key is a fault.
  double number(const toml::table& table, std::string_view key, const std::string& where,
                std::optional<double> fallback = std::nullopt);
  std::string text(const toml::table& table, std::string_view key, const std::string& where,
                   std::optional<std::string> fallback = std::nullopt);
  // Nothing, with a fault, where the key is missing or does not hold `count` finite numbers.
  std::optional<std::vector<double>> numbers(const toml::table& table, std::string_view key,
                                             const std::string& where, std::size_t count);
  std::optional<Vector3> vector3(const toml::table& table, std::string_view key,
                                 const std::string& where);
  std::vector<std::string> texts(const toml::table& table, std::string_view key,
                                 const std::string& where);
  // The tables of [[key]]; none where there is no such key.
  std::vector<const toml::table*> tables(const toml::table& table, std::string_view key,
                                         const std::string& where);
  // [key]; nullptr where there is no such key.
  const toml::table* table(const toml::table& parent, std::string_view key,
                           const std::string& where);

 private:
  std::string file_;
  std::vector<Diagnostic>& faults_;
};

}  // namespace twinarm
