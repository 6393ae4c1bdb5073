// Overlays: what can be laid over the bodies, by name, as entries of the DrawList. A new one is a
// file with one function, its declaration here, and its line in overlays.cpp.
#pragma once

#include <string>
#include <vector>

#include "app/draw/scene_view.h"

namespace twinarm {

struct Overlay {
  const char* name;  // of --show
  const char* what;  // in the help
  void (*add)(Stage& stage, const Moment& moment);
  bool seen_through = true;  // faintly where bodies hide it
};

// In the order in which they are drawn and stand in the legend.
const std::vector<Overlay>& all_overlays();
// After those, of a run that somebody works on: no recording has what they show.
const std::vector<Overlay>& live_overlays();

// "forces,contacts"; "none"; "all". Throws InputError with all faults.
std::vector<std::string> parse_overlays(const std::string& text);

// What one of them has put into stage.list: from there to where the next one begins.
struct Drawn {
  const Overlay* overlay = nullptr;  // null: the bodies
  std::size_t instance = 0, label = 0, legend = 0;
};
// Names of overlays. Fills stage.list: the bodies first, then the overlays in the order above.
std::vector<Drawn> draw(Stage& stage, const Moment& moment,
                        const std::vector<std::string>& overlays);

void show_twins(Stage& stage, const Moment& moment);
void show_device(Stage& stage, const Moment& moment);
void show_couplings(Stage& stage, const Moment& moment);
void show_contacts(Stage& stage, const Moment& moment);
void show_forces(Stage& stage, const Moment& moment);
void show_gravity(Stage& stage, const Moment& moment);
void show_joints(Stage& stage, const Moment& moment);
void show_frames(Stage& stage, const Moment& moment);
void show_com(Stage& stage, const Moment& moment);
void show_momentum(Stage& stage, const Moment& moment);
void show_inertia(Stage& stage, const Moment& moment);
void show_articulated(Stage& stage, const Moment& moment);
void show_trails(Stage& stage, const Moment& moment);
void show_labels(Stage& stage, const Moment& moment);
void show_energy(Stage& stage, const Moment& moment);
void show_felt(Stage& stage, const Moment& moment);
void show_pull(Stage& stage, const Moment& moment);
void show_before(Stage& stage, const Moment& moment);

// "12.3 N", "4.57 kN": three digits.
std::string with_unit(double value, const std::string& unit);
// An arc about an axis with an arrow's head, three quarters of a turn in the sense of the axis.
void add_turn_arrow(DrawList& list, const Vector3& center_W, const Vector3& axis_W, double radius,
                    double thickness, const Color& color);
// The scale of arrows, as the legend says it behind their name: " (0.1 m = 50 N)".
std::string scale_words(double metres_per, double length, const std::string& unit);

}  // namespace twinarm
