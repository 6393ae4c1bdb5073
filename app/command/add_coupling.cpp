// The options of `twinarm coupling predict` and `coupling gains`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_coupling(CLI::App& app, CommandLine& line) {
  const auto predicted = std::make_shared<CouplingPredictOptions>();
  const auto gains = std::make_shared<CouplingGainsOptions>();
  CLI::App* coupling = app.add_subcommand(
      "coupling",
      "What theory says of a scene's couplings before it is run\n\n"
      "Example:  twinarm coupling predict assets/scenes/robot_beside_obstacles.toml");
  coupling->require_subcommand(1);
  CLI::App* predict = coupling->add_subcommand(
      "predict",
      "Stiffness, modes, limits of step and stiffness, errors behind a moving target, sag\n\n"
      "Example:  twinarm coupling predict assets/scenes/robot_beside_obstacles.toml --step 0.004");
  add_robot_options(*predict, predicted->robot,
                    "a scene in TOML, with couplings; or a URDF, with --link and --stiffness");
  predict->add_option("--type", predicted->type, "of a URDF's coupling, as in a scene")
      ->capture_default_str();
  predict->add_option("--link", predicted->link, "likewise: the link that is pulled");
  predict->add_option("--point", predicted->point, "likewise: x,y,z in link axes [m]");
  predict->add_option("--measure", predicted->measure, "likewise: world or joint");
  predict->add_option("--treatment", predicted->treatment, "likewise");
  predict->add_option("--stiffness", predicted->stiffness, "likewise [N/m or N m/rad]");
  predict->add_option("--damping", predicted->damping, "likewise [N s/m or N m s/rad]");
  predict->add_option("--step", predicted->step, "seconds; the scene's if not given");
  predict->add_option("--integrator", predicted->integrator, "the scene's if not given");
  predict->add_option("--turn", predicted->turn, "how far the target goes [deg, or mm]")
      ->capture_default_str();
  predict->add_option("--time", predicted->time, "in which time [s]")->capture_default_str();
  predict->add_option("--along", predicted->along,
                      "joint=part,..: what part of it each joint goes; all of it if not given");
  predict->add_option("--wall", predicted->wall, "stiffness of a wall in the way [N/m]");
  predict->add_flag("--json", predicted->json, "print one JSON object on stdout");
  predict->callback([predicted, &line] {
    line.chosen = [predicted] { return run_coupling_predict(*predicted); };
  });
  CLI::App* same = coupling->add_subcommand(
      "gains",
      "The same gains as a frequency, as a torsional coupling, in MuJoCo and as a PhysX drive\n\n"
      "Example:  twinarm coupling gains --inertia 0.5 --frequency 8 --damping-ratio 1");
  add_input_option(*same, "model", gains->robot.model,
                   "a scene in TOML, with couplings; may be left out");
  add_input_option(*same, "--state", gains->robot.state, "JSON file: q");
  same->add_option("--frequency", gains->frequency, "wanted [Hz]");
  same->add_option("--damping-ratio", gains->damping_ratio, "wanted");
  same->add_option("--inertia", gains->inertia, "without a scene: what is moved [kg or kg m^2]");
  same->add_option("--stiffness", gains->stiffness, "without a scene [N/m or N m/rad]");
  same->add_option("--damping", gains->damping, "likewise [N s/m or N m s/rad]");
  same->add_option("--solref", gains->solref,
                   "likewise, MuJoCo's timeconst,dampratio or -stiffness,-damping");
  same->add_option("--impedance", gains->impedance, "MuJoCo's d, or d,dmax; 0.95 if not given");
  same->add_flag("--json", gains->json, "print one JSON object on stdout");
  same->callback([gains, &line] { line.chosen = [gains] { return run_coupling_gains(*gains); }; });
}

}  // namespace twinarm
