// The options of `twinarm inspect`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_inspect(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<InspectOptions>();
  CLI::App* inspect = app.add_subcommand(
      "inspect",
      "The passes of the articulated-body algorithm with their numbers, every wrench on every "
      "body, and checks by second ways\n\n"
      "Example:  twinarm inspect assets/robots/s103/s103.urdf --body arm2");
  add_robot_options(*inspect, options->robot, "the robot's URDF, a scene in TOML, or a recording");
  inspect->add_option("--pass", options->passes, "1, 2 or 3; all if not given");
  inspect->add_option("--body", options->bodies, "names of links and bodies; all if not given");
  inspect
      ->add_option("--axes", options->axes,
                   "of the wrenches: world, link (each body its own), or the name of a body")
      ->capture_default_str();
  inspect
      ->add_option("--about", options->about,
                   "where torques are taken: origin or com (each body its own), the name of a "
                   "body, or a point x,y,z of the world")
      ->capture_default_str();
  inspect->add_option("--force", options->forces,
                      "read out these alone: coupling/NAME, contact/A-B, constraint/NAME ..");
  inspect->add_option("--at", options->at, "seconds; of a recording; its end if not given");
  inspect->add_option("--step", options->step, "of a scene: seconds; the scene's if not given");
  add_file_option(*inspect, "--html", options->html, "write a page that steps through the passes");
  inspect->add_flag("--json", options->json, "print one JSON object on stdout");
  options->command = line.words;
  inspect->callback(
      [options, &line] { line.chosen = [options] { return run_inspect(*options); }; });
}

}  // namespace twinarm
