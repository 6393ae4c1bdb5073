// One episode of the soak run: a scene from its start for some seconds, shoved about and watched.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace twinarm::soak {

struct EpisodeResult {
  double seconds = 0;  // simulated
  long steps = 0;
  long unconverged = 0;  // steps that say so
  long above = 0;        // steps with a residual above kResidual
  long infeasible_impacts =
      0;                   // impacts that were taken without restitution, as no velocities obey it
  double residual = 0;     // the largest [m/s]
  double residual_at = 0;  // its time [s]
  double depth = 0;        // the deepest contact at the start of a step [m]
  long deep = 0;           // steps that began deeper than a micrometre
  double created = -1e99;  // largest of EnergyBooks, over the scale of energy; 0 is none
  double given = 0;        // likewise; 0 where there are robots
  double apart = 0;        // likewise, of all steps up to then
  double excess = -1e99;   // likewise
  double work = 0;         // of shoves and hands, at the end [J]
  int contacts = 0;        // the most at a time
  std::string fault;       // what was broken first, and when; empty: nothing

  static constexpr double kResidual = 1e-8;  // [m/s]
};

// What stops an episode.
struct Bounds {
  double created = 1e-9;   // of the scale of energy; given likewise
  double excess = 0.1;     // likewise: coordinates and rolling are of first order in h
  double depth = 2e-3;     // [m]
  double residual = 1e-3;  // [m/s]
};

// The same arguments give the same run, to the last bit. `go_on` is asked now and then; false ends
// it.
EpisodeResult run_episode(const std::string& scene, std::uint64_t seed, long episode,
                          double seconds, const std::function<bool()>& go_on);

}  // namespace twinarm::soak
