// The options of `twinarm lab`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_lab(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<LabOptions>();
  CLI::App* lab = app.add_subcommand(
      "lab",
      "A laboratory in the browser: grab the robot, turn the gains, look at every force\n\n"
      "Example:  twinarm lab assets/scenes/hand_and_obstacles.toml\n\n"
      "Prints the page's address and opens it where there is a browser; Ctrl-C ends it. On another "
      "machine: ssh -L 8080:127.0.0.1:8080 HOST, and there: twinarm lab --port 8080 --no-browser");
  add_input_option(*lab, "scene", options->scene,
                   "a scene, a URDF or a recording; left out: the first of the gallery");
  lab->get_option("scene")->required(false);
  lab->add_option("--lanes", options->lanes,
                  "runs of the scene side by side, one for each value: PATH=VALUE,VALUE.., as "
                  "integrator=semi-implicit,rk4 or coupling.stiffness=500,2000")
      ->type_name("PATH=VALUES");
  lab->add_option("--port", options->port, "of the server; left out: any that is free")
      ->check(between(0, 65535));
  lab->add_option("--listen", options->listen,
                  "address: another than 127.0.0.1 lets others on the network in who have the "
                  "page's address with its token")
      ->capture_default_str();
  lab->add_option("--remember", options->remember,
                  "megabytes of frames: how far back one can go, some minutes at 256")
      ->check(between(1, 65536))
      ->capture_default_str();
  lab->add_flag("--no-browser", options->no_browser, "only print the address");
  lab->add_flag("--json", options->json, "print {\"url\": \"..\"} as the first line");
  lab->callback([options, &line] { line.chosen = [options] { return run_lab(*options); }; });
}

}  // namespace twinarm
