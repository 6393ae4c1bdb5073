// Overlays: named layers of the DrawList over the bodies. A file NAME_overlay.cpp of this folder
// defines `Overlays NAME_overlay()`, one or several related; --show, the legend, the lab and pages
// list them (docs/develop/extending.md).
#pragma once

#include <string>
#include <vector>

#include "app/draw/scene_view.h"

namespace twinarm {

struct OverlayOptions {
  enum class Shown { no, on_pages, everywhere };
  bool seen_through = true;  // faintly visible through bodies
  Shown shown = Shown::no;   // by default
  bool is_live = false;      // of the lab only: recordings lack its data
};
struct Overlay {
  using Shown = OverlayOptions::Shown;
  int place = 0;          // order of drawing and of the legend
  const char* name = "";  // of --show
  const char* what = "";  // in the help
  void (*add)(SceneView& view, const Snapshot& snapshot) = nullptr;
  OverlayOptions options = {};
};
using Overlays = std::vector<Overlay>;
const std::vector<Overlays>& overlays_of_files();

// By `place`: all but the live ones; the live ones.
const Overlays& all_overlays();
const Overlays& live_overlays();

// Names of those shown by default, by `place`.
std::vector<std::string> usual_overlays(Overlay::Shown at_least);

// "forces,contacts"; "none"; "all". Throws InputError.
std::vector<std::string> parse_overlays(const std::string& text);

// First entries of an overlay in view.list; they end where the next overlay begins.
struct Drawn {
  const Overlay* overlay = nullptr;  // null: the bodies, or the end of the list
  std::size_t instance = 0, label = 0, legend = 0;
};
// Fills view.list: the bodies, then the named overlays by `place`; the last entry is the end.
std::vector<Drawn> draw(SceneView& view, const Snapshot& snapshot,
                        const std::vector<std::string>& overlays);

// Wrenches on each body (free-body diagrams) where they act, forces and torques: "wrenches" of
// --show, of pictures only, as each instant takes a step of the run.
struct Inspection;
void add_wrenches(SceneView& view, const Inspection& in);

// "12.3 N", "4.57 kN": three digits.
std::string with_unit(double value, const std::string& unit);
// An arc of 270 degrees about an axis with an arrow's head.
void add_rotation_arrow(DrawList& list, const Vector3& center_W, const Vector3& axis_W,
                        double radius, double thickness, const Color& color);
// Scale of arrows for the legend: " (0.1 m = 50 N)".
std::string scale_words(double metres_per, double length, const std::string& unit);

}  // namespace twinarm
