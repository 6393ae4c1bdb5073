// `twinarm coupling gains`: one spring-damper in the parameters of other couplings and engines.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/run/simulate_input.h"
#include "coupling/analysis/gains.h"

namespace twinarm {

struct Equivalents {
  std::string name, kind;  // of a scene's coupling; empty of gains from the command line
  bool is_length = true;   // N/m, N s/m and kg; else N m/rad, N m s/rad and kg m^2
  bool is_weld = false;    // the gains are those of a spring with its frequency and damping ratio
  double inertia = 0;      // smallest apparent inertia [kg or kg m^2]
  SpringGains gains;
  SpringResponse response;
  std::optional<SpringGains> wanted;        // for the requested frequency and damping ratio
  std::optional<SpringGains> as_torsional;  // of a point spring, about the joint of its link
  double radius = 0;                        // about that joint [m]
  std::optional<Solref> solref, direct;  // (timeconst, dampratio) only where k and b are positive
  double static_stiffness = 0;           // of MuJoCo's constraint under a constant load
  Drive force_drive, acceleration_drive;
};

Equivalents equivalents_of(const SpringGains& gains, double inertia,
                           const MujocoImpedance& impedance);

// Of each coupling with a stiffness, at the state of the scene.
std::vector<Equivalents> scene_equivalents(SimulateInput& input,
                                           const std::optional<SpringResponse>& wanted,
                                           const MujocoImpedance& impedance);

std::string equivalents_table(const std::vector<Equivalents>& all, double step);
std::string equivalents_json(const std::vector<Equivalents>& all);

}  // namespace twinarm
