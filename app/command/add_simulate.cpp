// The options of `twinarm simulate`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_simulate(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App* simulate = app.add_subcommand(
      "simulate",
      "Let a robot or a scene move, under gravity, couplings, constant torques and forces\n\n"
      "Example:  twinarm simulate assets/robots/puma560/puma560.urdf --duration 1 --every 0.1");
  add_robot_options(*simulate, options->robot, "the robot's URDF, or a scene in TOML");
  std::string names;
  for (const IntegratorFacts& facts : all_integrators) names += std::string(" ") + facts.name;
  simulate->add_option("--duration", options->duration,
                       "seconds; if not given, as long as the scene says");
  simulate->add_option("--step", options->step,
                       "seconds; 0.001 or the scene's if not given; of dopri5 the longest");
  simulate->add_option("--integrator", options->integrator,
                       "semi-implicit or the scene's if not given; one of" + names);
  simulate->add_option("--contact", options->contact,
                       "how bodies of a scene are kept apart; its own word if not given; one of "
                       "rigid compliant event");
  simulate->add_option("--tolerance", options->tolerance, "of dopri5, relative and absolute");
  simulate->add_option("--every", options->every, "a sample each so many seconds");
  simulate->add_option("--at", options->at, "samples at these times: t1,t2,..");
  add_file_option(*simulate, "--record", options->record,
                  "write a recording of the run to this file");
  simulate->add_option("--record-every", options->record_every,
                       "seconds between its frames; each step if not given");
  simulate->add_option("--energy-bound", options->energy_bound,
                       "joules of kinetic energy at which the run stops; inf: none");
  add_file_option(*simulate, "--post-mortem", options->post_mortem,
                  "where the last steps of a run go that stops by itself; in out/ if not "
                  "given");
  simulate->add_flag("--json", options->json, "print one JSON object on stdout");
  simulate->add_flag("--csv", options->csv, "print one row a sample on stdout");
  options->command = line.words;
  simulate->callback(
      [options, &line] { line.chosen = [options] { return run_simulate(*options); }; });
}

}  // namespace twinarm
