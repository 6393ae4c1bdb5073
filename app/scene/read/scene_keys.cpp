// Keys of surfaces; numbers within their ranges; units.
#include "app/scene/read/scene_keys.h"

#include <algorithm>
#include <array>
#include <utility>

#include "app/robot/robot_input.h"
#include "app/scene/read/change_scene.h"

namespace twinarm {

using S = NumberRange::Sign;

const std::vector<SurfaceKey>& surface_keys() {
  using P = PairDescription;
  // clang-format off
  static const std::vector<SurfaceKey> rows{
      {.key = "friction", .member = &Surface::friction, .of_pair = &P::friction,
       .slider = {"friction", 0, 2, "Coulomb's: a pair takes the geometric mean of its two.",
                  SliderRow::linear}},
      {.key = "restitution",
       .range = {S::not_negative, [](double e) { return e <= 1; },
                 "must be at most 1: an impact creates no energy", "give a number from 0 to 1"},
       .member = &Surface::restitution, .of_pair = &P::restitution,
       .slider = {"restitution", 0, 1, "Speed after an impact over speed before: a pair takes the "
                  "product.", SliderRow::linear}},
      {.key = "torsional_friction", .unit = "m", .member = &Surface::torsional_friction},
      {.key = "rolling_friction", .unit = "m", .member = &Surface::rolling_friction},
      {.key = "stiffness", .unit = "N/m", .range = {S::positive},
       .member = &Surface::stiffness, .of_pair = &P::stiffness,
       .slider = {"contact stiffness", 1e3, 1e9, "Of each contact point; two surfaces are springs "
                  "in series."},
       .is_of_compliant = true},
      {.key = "dissipation", .unit = "s/m",
       .member = &Surface::dissipation, .of_pair = &P::dissipation}};
  // clang-format on
  return rows;
}

std::optional<double> read_number(TableReader& table, const char* key, const NumberRange& range) {
  const auto value = range.sign == S::positive       ? table.positive(key)
                     : range.sign == S::not_negative ? table.not_negative(key)
                                                     : table.number(key);
  if (value && range.fits && !range.fits(*value))
    table.fault(key, range.rule, range.remedy, "scene.range");
  return value;
}

namespace {

// Of the coupling that a table is: whether its gains are of turns.
bool turns_link(const Value& table) {
  const Value* type = table.find("type");
  return type && type->text == "torsional";
}

// Keys that are read one by one.
constexpr std::array<std::pair<const char*, const char*>, 15> kOtherUnits{
    {{"step", "s"},
     {"duration", "s"},
     {"gravity", "m/s²"},
     {"mass", "kg"},
     {"density", "kg/m³"},
     {"inertia", "kg m²"},
     {"position", "m"},
     {"point", "m"},
     {"point_b", "m"},
     {"com", "m"},
     {"offset", "m"},
     {"linear_velocity", "m/s"},
     {"linear", "m/s"},
     {"angular_velocity", "rad/s"},
     {"angular", "rad/s"}}};

}  // namespace

std::string unit_of_number(const Value& scene, const std::string& text) {
  Value copy = scene;
  const ValuePath path(text);
  FaultList ignored;
  const auto found =
      attempt(ignored, [&] { return find_targets(copy, path, MadeKeys::last, 0, text); });
  if (!found) return "";
  const std::string& key = path.parts.back().name;
  if (path.parts.size() > 1 && path.parts.front().name == "coupling")
    for (const CouplingKey& row : coupling_keys()) {
      if (key != row.key) continue;
      const bool turns = turns_link(*found->front().table);
      const bool agree = std::all_of(found->begin(), found->end(), [&](const PathTarget& target) {
        return turns_link(*target.table) == turns;
      });
      return row.turning_unit && !agree ? "" : row.unit_of(turns);
    }
  for (const SurfaceKey& row : surface_keys())
    if (key == row.key) return row.unit;
  for (const auto& [name, unit] : kOtherUnits)
    if (key == name) return unit;
  std::string unit;
  for_each_shape([&](const auto& shape) {
    if constexpr (requires { shape.lengths(); })
      for_each_length(shape, [&](const char* length, const auto&) {
        if (key == length) unit = "m";
      });
  });
  return unit;
}

}  // namespace twinarm
