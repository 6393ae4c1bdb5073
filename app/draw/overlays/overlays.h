// Overlays: what can be laid over the bodies, by name, as entries of the DrawList. A file
// NAME_overlay.cpp of this folder defines `Overlays NAME_overlay()`, one or those that are alike;
// --show, the legend, the lab and pages list them (docs/develop/extending.md).
#pragma once

#include <string>
#include <vector>

#include "app/draw/scene_view.h"

namespace twinarm {

struct Overlay {
  enum class Shown { no, on_pages, everywhere };
  int place = 0;          // in which they are drawn and stand in the legend, ascending
  const char* name = "";  // of --show
  const char* what = "";  // in the help
  void (*add)(SceneView& stage, const Snapshot& moment) = nullptr;
  bool seen_through = true;  // faintly where bodies hide it
  Shown shown = Shown::no;   // where nobody has chosen
  bool is_live = false;      // of a run that somebody works on: no recording has what it shows
};
using Overlays = std::vector<Overlay>;
const std::vector<Overlays>& overlays_of_files();

// In their order; after them those of a run that somebody works on.
const Overlays& all_overlays();
const Overlays& live_overlays();

// Names of those that are shown where nobody has chosen, in their order.
std::vector<std::string> usual_overlays(Overlay::Shown least);

// "forces,contacts"; "none"; "all". Throws InputError with all faults.
std::vector<std::string> parse_overlays(const std::string& text);

// What one of them has put into stage.list: from there to where the next one begins.
struct Drawn {
  const Overlay* overlay = nullptr;  // null: the bodies
  std::size_t instance = 0, label = 0, legend = 0;
};
// Names of overlays. Fills stage.list: the bodies first, then the overlays in the order above.
std::vector<Drawn> draw(SceneView& stage, const Snapshot& moment,
                        const std::vector<std::string>& overlays);

// "12.3 N", "4.57 kN": three digits.
std::string with_unit(double value, const std::string& unit);
// An arc about an axis with an arrow's head, three quarters of a turn in the sense of the axis.
void add_turn_arrow(DrawList& list, const Vector3& center_W, const Vector3& axis_W, double radius,
                    double thickness, const Color& color);
// The scale of arrows, as the legend says it behind their name: " (0.1 m = 50 N)".
std::string scale_words(double metres_per, double length, const std::string& unit);

}  // namespace twinarm
