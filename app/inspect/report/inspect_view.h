// What `twinarm inspect` is asked to show, out of its options.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/inspect/report/inspect_output.h"
#include "app/robot/robot_input.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// Options of `twinarm inspect`.
struct InspectOptions {
  std::filesystem::path html;  // a page; empty: text on stdout
  RobotOptions robot;
  std::vector<std::string> passes, bodies;  // none: all
  std::string axes = "world";               // of the wrenches: world, link, or a body's name
  std::string about = "origin";             // origin, com, a body's name, or x,y,z in the world
  std::vector<std::string> forces;          // by name; none: all
  std::optional<double> step;               // of a scene [s]; left out: the scene's
  std::optional<double> at;                 // of a recording [s]; left out: its end
  bool json = false;
};

// --pass; all if none is given.
void read_passes(const InspectOptions& options, InspectView& view, DiagnosticList& faults);
// --body, --axes, --about: names of bodies.
void read_bodies(const InspectOptions& options, const Model<double>& model, InspectView& view,
                 DiagnosticList& faults);
// --force: the whole name of a force, or what stands after its first slash; of a contact with
// several points without their numbers all of them.
void read_forces(const InspectOptions& options, const std::vector<AppliedForce>& actors,
                 InspectView& view, DiagnosticList& faults);

}  // namespace twinarm
