// The options of `twinarm render`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_render(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* render = app.add_subcommand(
      "render",
      "A picture or a film of a recording, a scene or a robot, without display or GPU\n\n"
      "Example:  twinarm render assets/scenes/incline.toml --png incline.png --show "
      "forces,contacts");
  add_robot_options(*render, options->robot, "a recording, a scene in TOML, or a robot's URDF");
  add_file_option(*render, "--png", options->png, "write one picture to this file");
  add_file_option(*render, "--frames", options->frames,
                  "write a film as numbered PNG into this folder");
  add_file_option(*render, "--mp4", options->mp4, "write a film (needs the program ffmpeg)");
  add_file_option(*render, "--gif", options->gif, "likewise, as GIF");
  render->add_option(
      "--at", options->at,
      "seconds, of the picture; if not given the end of a recording, else the start");
  render->add_option("--from", options->from, "seconds, where the film begins");
  render->add_option("--to", options->to, "seconds, where it ends");
  render->add_option("--slow", options->slow, "times slower than life")->capture_default_str();
  render->add_option("--fps", options->fps, "pictures per second; 30 if not given, of a GIF 25");
  render->add_option("--size", options->size, "in pixels")->capture_default_str();
  render
      ->add_option("--camera", options->camera,
                   "auto, front, side, top, iso, follow:BODY, or AZIMUTH,ELEVATION[,DISTANCE] in "
                   "degrees and metres")
      ->capture_default_str();
  render
      ->add_option("--show", options->show,
                   "none, all, or some of: ghost trails couplings contacts forces gravity joints "
                   "frames com momentum inertia articulated labels energy")
      ->capture_default_str();
  render
      ->add_option("--plot", options->plot,
                   "curves under the picture: none, or some of energy forces couples contacts lag")
      ->capture_default_str();
  add_file_option(*render, "--beside", options->beside,
                  "a second recording, in sync at the right of the first");
  render->add_option("--quality", options->quality, "draft, normal or studio")
      ->capture_default_str();
  render->add_option("--background", options->background, "studio, sky or white")
      ->capture_default_str();
  render->add_option("--gl", options->gl, "what paints: osmesa or egl")->capture_default_str();
  render->add_flag("--json", options->json, "print one JSON object on stdout");
  render->callback([options, &line] { line.chosen = [options] { return run_render(*options); }; });
}

}  // namespace twinarm
