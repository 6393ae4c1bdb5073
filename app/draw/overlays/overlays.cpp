#include "app/draw/overlays/overlays.h"

#include <fmt/format.h>

#include "app/draw/curves.h"
#include "app/support/text.h"
#include "solver/spatial/rotation_to_axis.h"

namespace twinarm {
namespace {

Overlays in_order(bool is_live) {
  Overlays found;
  for (const Overlays& of_file : overlays_of_files())
    for (const Overlay& overlay : of_file)
      if (overlay.options.is_live == is_live) found.push_back(overlay);
  std::ranges::sort(found, {}, &Overlay::place);
  return found;
}

}  // namespace

const Overlays& all_overlays() {
  static const Overlays all = in_order(false);
  return all;
}

const Overlays& live_overlays() {
  static const Overlays all = in_order(true);
  return all;
}

std::vector<std::string> usual_overlays(Overlay::Shown at_least) {
  std::vector<std::string> names;
  for (const Overlay& overlay : all_overlays())
    if (overlay.options.shown >= at_least) names.emplace_back(overlay.name);
  return names;
}

std::vector<std::string> parse_overlays(const std::string& text) {
  std::vector<std::string> known = usual_overlays(Overlay::Shown::no);
  known.emplace_back("wrenches");
  return parse_names(text, "--show", "overlay", known);
}

std::vector<Drawn> draw(SceneView& view, const Snapshot& snapshot,
                        const std::vector<std::string>& overlays) {
  DrawList& list = view.list;
  draw_bodies(view, snapshot);
  std::vector<Drawn> drawn{{}};
  for (const auto* known : {&all_overlays(), &live_overlays()})
    for (const Overlay& overlay : *known) {
      if (std::ranges::find(overlays, overlay.name) == overlays.end()) continue;
      const std::size_t first = list.instances.size();
      drawn.push_back({&overlay, first, list.labels.size(), list.legend.size()});
      overlay.add(view, snapshot);
      for (std::size_t i = first; i < list.instances.size(); ++i)
        list.instances[i].seen_through = overlay.options.seen_through;
    }
  drawn.push_back({nullptr, list.instances.size(), list.labels.size(), list.legend.size()});
  return drawn;
}

std::string with_unit(double value, const std::string& unit) {
  if (value == 0) return "0 " + unit;
  const SiPrefix prefix = si_prefix(value);
  // No prefix for products of units and kg, nor for less than 1e-6.
  if (unit.find(' ') != std::string::npos || unit == "kg" || prefix.factor < 1e-6)
    return fmt::format("{:.3g} {}", value, unit);
  return fmt::format("{:.3g} {}{}", value / prefix.factor, prefix.name, unit);
}

void add_rotation_arrow(DrawList& list, const Vector3& center_W, const Vector3& axis_W,
                        double radius, double thickness, const Color& color) {
  if (!(axis_W.norm() > 0) || !axis_W.allFinite()) return;
  constexpr int kPieces = 20;
  constexpr double kTurn = 1.5 * std::numbers::pi;
  const Matrix3 R = rotation_taking_z_to(axis_W);
  const auto at = [&](double angle) {
    return Vector3(center_W + radius * (std::cos(angle) * R.col(0) + std::sin(angle) * R.col(1)));
  };
  const double head = std::min(0.6, 6.5 * thickness / radius);  // [rad]
  for (int i = 0; i < kPieces; ++i)
    add_rod(list, at((kTurn - head) * i / kPieces), at((kTurn - head) * (i + 1) / kPieces),
            thickness, color);
  add_mesh_instance(
      list, list.unit_mesh(UnitShape::cone),
      {rotation_taking_z_to(at(kTurn) - at(kTurn - head)), at(kTurn - head)}, color,
      Vector3(2.4 * thickness, 2.4 * thickness, (at(kTurn) - at(kTurn - head)).norm()));
}

std::string scale_words(double metres_per, double length, const std::string& unit) {
  if (!(metres_per > 0)) return "";
  const double shown = round_down(0.3 * length);
  return fmt::format(" ({} = {})", with_unit(shown, "m"), with_unit(shown / metres_per, unit));
}

}  // namespace twinarm
