#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/data/json_writer.h"
#include "app/data/number_sheet.h"
#include "app/data/text_table.h"
#include "app/modes/modes_input.h"

namespace twinarm {
namespace {

void write_shape(JsonWriter& json, const SimulateInput& input, const ModesOf& found,
                 const Eigen::VectorXd& by_velocity) {
  json.object([&] {
    for (const NamedJoint& joint : found.joints)
      json.key(name_of_part(input, joint)).number_or_list(shape_part(input, joint, by_velocity));
  });
}

const char* word_for(const Mode& mode) {
  constexpr double kNothing = 1e-9;
  const double part = mode.damping_ratio();
  if (mode.eigenvalue == 0.0) return "drifts";
  if (part < -kNothing) return mode.eigenvalue.imag() > 0 ? "swings, growing" : "grows";
  return mode.eigenvalue.imag() > 0 ? "swings" : "decays";
}

// A number; size and phase where it is out of phase with the largest.
std::string shape_cell(double re, double im) {
  const double size = std::hypot(re, im), degrees = 180 / std::numbers::pi * std::atan2(im, re);
  if (size < 5e-5) return "0";
  return std::abs(im) < 1e-6 * size ? fmt::format("{:.4f}", re)
                                    : fmt::format("{:.3f}/{:.0f}", size, degrees);
}

constexpr std::size_t kModesInTable = 7;

std::string shape_table(const SimulateInput& input, const ModesOf& found, std::size_t first) {
  const std::size_t last = std::min(first + kModesInTable, found.modes.size());
  std::vector<std::string> headings{"joint"};
  for (std::size_t k = first; k < last; ++k) headings.push_back("mode " + std::to_string(k + 1));
  TextTable table(headings);
  for (const NamedJoint& joint : found.joints)
    for (const JointComponent& c : joint.components()) {
      if (c.v < 0) continue;
      const std::string name = name_of_part(input, joint);
      std::vector<std::string> line{*c.label ? name + "/" + c.label : name};
      const auto v = static_cast<std::size_t>(c.v);
      for (std::size_t k = first; k < last; ++k) {
        const Mode& mode = found.modes[k];
        line.push_back(shape_cell(shape_part(input, joint, mode.shape.real())[v],
                                  shape_part(input, joint, mode.shape.imag())[v]));
      }
      table.add(line);
    }
  return table.str();
}

}  // namespace

std::string modes_json(const SimulateInput& input, const ModesOf& found) {
  JsonWriter json;
  const auto write_mode = [&](const Mode& mode) {
    json.object({{"frequency", mode.frequency()},
                 {"damping_ratio", mode.damping_ratio()},
                 {"eigenvalue", std::array{mode.eigenvalue.real(), mode.eigenvalue.imag()}},
                 {"shape", [&] { write_shape(json, input, found, mode.shape.real()); }},
                 {"shape_imaginary", [&] { write_shape(json, input, found, mode.shape.imag()); }}});
  };
  json.object({{"modes", [&] { json.list(found.modes, write_mode); }},
               {"rows", found.rows},
               {"A", found.looped.system.A},
               {"B", found.looped.system.B},
               {"warnings", found.warnings}});
  return json.str();
}

std::string modes_table(const SimulateInput& input, const ModesOf& found) {
  std::string text = fmt::format(
      "{}: small motions about the state, x' = A x + B tau, "
      "x = exp(lambda t)\n",
      input.robot.robot.name);
  std::string leads;
  for (const std::string& row : found.rows) leads += (leads.empty() ? "" : ", ") + row;
  if (input.scene && !input.scene->constraints.empty())
    text += wrapped(fmt::format("constraints hold; degrees of freedom: {}{}", found.rows.size(),
                                leads.empty() ? "" : ", told by " + leads)) +
            "\n";
  text += "\n";
  TextTable table(
      {"mode", "frequency [rad/s]", "[Hz]", "period [s]", "damping ratio", "lambda [1/s]", "it"});
  const auto clean = [](double value) { return cell(std::abs(value) < 1e-12 ? 0 : value); };
  for (std::size_t k = 0; k < found.modes.size(); ++k) {
    const Mode& mode = found.modes[k];
    const double w = mode.frequency(), turn = 2 * std::numbers::pi;
    const double swing = mode.eigenvalue.imag();
    table.add({std::to_string(k + 1), cell(w), cell(w / turn), swing > 0 ? cell(turn / swing) : "-",
               clean(mode.damping_ratio()),
               swing > 0 ? fmt::format("{} +- {}i", clean(mode.eigenvalue.real()), cell(swing))
                         : clean(mode.eigenvalue.real()),
               word_for(mode)});
  }
  text +=
      table.str() + "\nshapes, the largest part 1 (where parts are out of phase: size/degrees):\n";
  for (std::size_t first = 0; first < found.modes.size(); first += kModesInTable)
    text += shape_table(input, found, first) + "\n";
  for (const std::string& warning : found.warnings) text += wrapped("warning: " + warning) + "\n";
  return text;
}

}  // namespace twinarm
