// twinarm: the command line. Each command has a file of its own; this one knows their options.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/nearest_name.h"
#include "solver/fault.h"

namespace {

using namespace twinarm;

enum ExitCode { kDone = 0, kBadInput = 2, kInternal = 4, kInterrupted = 130 };

// All faults at once: on stderr for people, on stdout for machines too.
int tell(const InputError& error, bool as_json) {
  using Json = nlohmann::ordered_json;  // the one flavour of this program: it is compiled once
  Json errors = Json::array();
  for (const Fault& fault : error.faults()) {
    fmt::print(stderr, "twinarm: {}\n", to_string(fault));
    errors.push_back({{"file", fault.file},
                      {"line", fault.line},
                      {"remedy", fault.remedy},
                      {"rule", fault.rule},
                      {"where", fault.where}});
  }
  if (as_json) fmt::print("{}\n", Json{{"errors", errors}}.dump(1));
  return kBadInput;
}

void add_study(CLI::App& app, StudyOptions& options, std::function<int()>& command) {
  CLI::App* study =
      app.add_subcommand("study",
                         "The paper's study: E1 to E4, what explains them, and a report\n\n"
                         "Example:  twinarm study --out out/study");
  study->add_option("--out", options.out, "folder for report, figures, CSV")->capture_default_str();
  study
      ->add_option("--device", options.device,
                   "hand of E1 and E2: synthetic, or trace (default: trace if one is given)")
      ->check(CLI::IsMember({"synthetic", "trace"}));
  study->add_option("--seed", options.seed, "of the synthetic operator");
  study->add_option("--trace", options.trace, "CSV of a recorded hand, for E1 and E2");
  study->add_flag("--recalibrate", options.recalibrate,
                  "search the unpublished gains again and write them to the assets (minutes)");
  study->add_flag("--identify", options.identify,
                  "ask again what the paper's Table 2 leaves open, and write it to the assets "
                  "(some ten minutes)");
  study->add_flag("--paper-view", options.paper_view,
                  "hide the ghost in pictures, as the paper does");
  study->add_flag("--json", options.json, "print one JSON object on stdout");
  study->add_option("--assets", options.assets, "folder of robots and settings (found by itself)");
  study->callback([&] { command = [&] { return run_study(options); }; });
}

void add_make_robot(CLI::App& app, std::string& recipe, std::function<int()>& command) {
  CLI::App* make = app.add_subcommand(
      "make-robot",
      "Make a robot's URDF and collision hulls from its CAD meshes and densities\n\n"
      "Example:  twinarm make-robot assets/robots/s103/robot.toml");
  make->add_option("recipe", recipe, "the robot's TOML recipe")->required();
  make->callback([&] { command = [&] { return run_make_robot(recipe); }; });
}

void add_trace(CLI::App& app, TraceOptions& options, std::function<int()>& command) {
  CLI::App* trace =
      app.add_subcommand("trace",
                         "Write the synthetic operator's hand as a CSV trace\n\n"
                         "Example:  twinarm trace --seed 1 --rate 200 --out hand.csv");
  trace->add_option("--seed", options.seed, "of the synthetic operator")->capture_default_str();
  trace->add_option("--duration", options.duration, "seconds")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  trace->add_option("--rate", options.rate, "samples per second")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  trace->add_option("--out", options.out, "CSV file")->required();
  trace->callback([&] { command = [&] { return run_trace(options); }; });
}

// What `dynamics` and `simulate` are both given.
void add_robot_options(CLI::App& command, RobotOptions& options, const char* model) {
  command.add_option("model", options.model, model)->required();
  command.add_option("--state", options.state, "JSON file: q, qd, tau, qdd, base, wrenches");
  command.add_option("--gravity", options.gravity,
                     "x,y,z in world axes [m/s^2]; 0,0,-9.81 if not given");
  command.add_flag("--floating", options.floating, "the root link is free, not fixed to the world");
  command.add_flag_callback(
      "--no-friction", [&] { options.friction = false; }, "as if no joint had damping or friction");
  command.add_flag_callback(
      "--no-armature", [&] { options.armature = false; }, "as if no joint had a rotor's inertia");
  command.add_flag("--strict", options.strict, "refuse inertias that no body has");
}

void add_dynamics(CLI::App& app, DynamicsOptions& options, std::function<int()>& command) {
  CLI::App* dynamics = app.add_subcommand(
      "dynamics",
      "Forward and inverse dynamics, mass matrix, energies of a robot in one state\n\n"
      "Example:  twinarm dynamics assets/robots/puma560/puma560.urdf --state "
      "assets/states/puma_qn.json");
  add_robot_options(*dynamics, options.robot, "the robot's URDF");
  dynamics->add_flag("--json", options.json, "print one JSON object on stdout");
  dynamics->callback([&] { command = [&] { return run_dynamics(options); }; });
}

void add_inspect(CLI::App& app, InspectOptions& options, std::function<int()>& command) {
  CLI::App* inspect = app.add_subcommand(
      "inspect",
      "The passes of the articulated-body algorithm with their numbers, every wrench on every "
      "body, and checks by second ways\n\n"
      "Example:  twinarm inspect assets/robots/s103/s103.urdf --body arm2");
  add_robot_options(*inspect, options.robot, "the robot's URDF, a scene in TOML, or a recording");
  inspect->add_option("--pass", options.passes, "1, 2 or 3; all if not given");
  inspect->add_option("--body", options.bodies, "names of links and bodies; all if not given");
  inspect
      ->add_option("--axes", options.axes,
                   "of the wrenches: world, link (each body its own), or the name of a body")
      ->capture_default_str();
  inspect
      ->add_option("--about", options.about,
                   "where torques are taken: origin or com (each body its own), the name of a "
                   "body, or a point x,y,z of the world")
      ->capture_default_str();
  inspect->add_option("--force", options.forces,
                      "read out these alone: coupling/NAME, contact/A-B, constraint/NAME ..");
  inspect->add_option("--at", options.at, "seconds; of a recording; its end if not given");
  inspect->add_option("--step", options.step, "of a scene: seconds; the scene's if not given");
  inspect->add_option("--html", options.html, "write a page that steps through the passes");
  inspect->add_flag("--json", options.json, "print one JSON object on stdout");
  inspect->callback([&] { command = [&] { return run_inspect(options); }; });
}

void add_modes(CLI::App& app, ModesOptions& options, std::function<int()>& command) {
  CLI::App* modes = app.add_subcommand(
      "modes",
      "Frequencies, damping and shapes of small motions about a state, couplings of a scene "
      "included\n\n"
      "Example:  twinarm modes assets/robots/puma560/puma560.urdf");
  add_robot_options(*modes, options.robot, "the robot's URDF, or a scene in TOML");
  modes->add_flag("--json", options.json, "print one JSON object on stdout");
  modes->callback([&] { command = [&] { return run_modes(options); }; });
}

void add_coupling(CLI::App& app, CouplingPredictOptions& predicted, CouplingGainsOptions& gains,
                  std::function<int()>& command) {
  CLI::App* coupling = app.add_subcommand(
      "coupling",
      "What theory says of a scene's couplings before it is run\n\n"
      "Example:  twinarm coupling predict assets/scenes/robot_beside_obstacles.toml");
  coupling->require_subcommand(1);
  CLI::App* predict = coupling->add_subcommand(
      "predict",
      "Stiffness, modes, limits of step and stiffness, errors behind a moving target, sag\n\n"
      "Example:  twinarm coupling predict assets/scenes/robot_beside_obstacles.toml --step 0.004");
  add_robot_options(*predict, predicted.robot, "a scene in TOML, with couplings");
  predict->add_option("--step", predicted.step, "seconds; the scene's if not given");
  predict->add_option("--integrator", predicted.integrator, "the scene's if not given");
  predict->add_option("--turn", predicted.turn, "how far the target goes [deg, or mm]")
      ->capture_default_str();
  predict->add_option("--time", predicted.time, "in which time [s]")->capture_default_str();
  predict->add_option("--wall", predicted.wall, "stiffness of a wall in the way [N/m]");
  predict->add_flag("--json", predicted.json, "print one JSON object on stdout");
  predict->callback([&] { command = [&] { return run_coupling_predict(predicted); }; });
  CLI::App* same = coupling->add_subcommand(
      "gains",
      "The same gains as a frequency, as a torsional coupling, in MuJoCo and as a PhysX drive\n\n"
      "Example:  twinarm coupling gains --inertia 0.5 --frequency 8 --damping-ratio 1");
  same->add_option("model", gains.robot.model, "a scene in TOML, with couplings; may be left out");
  same->add_option("--state", gains.robot.state, "JSON file: q");
  same->add_option("--frequency", gains.frequency, "wanted [Hz]");
  same->add_option("--damping-ratio", gains.damping_ratio, "wanted");
  same->add_option("--inertia", gains.inertia, "without a scene: what is moved [kg or kg m^2]");
  same->add_option("--stiffness", gains.stiffness, "without a scene [N/m or N m/rad]");
  same->add_option("--damping", gains.damping, "likewise [N s/m or N m s/rad]");
  same->add_option("--solref", gains.solref,
                   "likewise, MuJoCo's timeconst,dampratio or -stiffness,-damping");
  same->add_option("--impedance", gains.impedance, "MuJoCo's d, or d,dmax; 0.95 if not given");
  same->add_flag("--json", gains.json, "print one JSON object on stdout");
  same->callback([&] { command = [&] { return run_coupling_gains(gains); }; });
}

void add_simulate(CLI::App& app, SimulateOptions& options, std::function<int()>& command) {
  CLI::App* simulate = app.add_subcommand(
      "simulate",
      "Let a robot or a scene move, under gravity, couplings, constant torques and forces\n\n"
      "Example:  twinarm simulate assets/robots/puma560/puma560.urdf --duration 1 --every 0.1");
  add_robot_options(*simulate, options.robot, "the robot's URDF, or a scene in TOML");
  std::string names;
  for (const IntegratorFacts& facts : all_integrators) names += std::string(" ") + facts.name;
  simulate->add_option("--duration", options.duration,
                       "seconds; if not given, as long as the scene says");
  simulate->add_option("--step", options.step,
                       "seconds; 0.001 or the scene's if not given; of dopri5 the longest");
  simulate->add_option("--integrator", options.integrator,
                       "semi-implicit or the scene's if not given; one of" + names);
  simulate->add_option("--contact", options.contact,
                       "how bodies of a scene are kept apart; its own word if not given; one of "
                       "rigid compliant event");
  simulate->add_option("--tolerance", options.tolerance, "of dopri5, relative and absolute");
  simulate->add_option("--every", options.every, "a sample each so many seconds");
  simulate->add_option("--at", options.at, "samples at these times: t1,t2,..");
  simulate->add_option("--record", options.record, "write a recording of the run to this file");
  simulate->add_option("--record-every", options.record_every,
                       "seconds between its frames; each step if not given");
  simulate->add_option("--energy-bound", options.energy_bound,
                       "joules of kinetic energy at which the run stops; inf: none");
  simulate->add_option("--post-mortem", options.post_mortem,
                       "where the last steps of a run go that stops by itself; in out/ if not "
                       "given");
  simulate->add_flag("--json", options.json, "print one JSON object on stdout");
  simulate->add_flag("--csv", options.csv, "print one row a sample on stdout");
  simulate->callback([&] { command = [&] { return run_simulate(options); }; });
}

void add_recordings(CLI::App& app, ExportOptions& exported, ReplayOptions& replayed,
                    std::function<int()>& command) {
  CLI::App* out =
      app.add_subcommand("export",
                         "A recording as CSV or JSON, units in the headers, or as a page that "
                         "replays it in any browser\n\n"
                         "Example:  twinarm export out/run.twinrec out/run.html");
  out->add_option("recording", exported.recording, "of `twinarm simulate --record`")->required();
  out->add_option("page", exported.page, "write one HTML file: picture, plots, ledger, settings");
  out->add_flag("--json", exported.json, "print one JSON object on stdout");
  out->add_flag("--csv", exported.csv, "print one row a frame on stdout");
  out->callback([&] { command = [&] { return run_export(exported); }; });
  CLI::App* replay = app.add_subcommand(
      "replay",
      "Run on from a recorded step: the same bits; or, with --set, a fork\n\n"
      "Example:  twinarm replay out/run.twinrec --from 0.5 --set coupling.stiffness=800");
  replay->add_option("recording", replayed.recording, "of `twinarm simulate --record`")->required();
  replay->add_option("--from", replayed.from, "seconds; the start if not given");
  replay->add_option("--set", replayed.changes, "PATH=VALUE of the scene, for a fork")
      ->allow_extra_args(false);
  replay->add_option("--plot", replayed.plot, "an SVG of both branches");
  replay->add_flag("--json", replayed.json, "print one JSON object on stdout");
  replay->callback([&] { command = [&] { return run_replay(replayed); }; });
}

void add_render(CLI::App& app, RenderOptions& options, std::function<int()>& command) {
  CLI::App* render = app.add_subcommand(
      "render",
      "A picture or a film of a recording, a scene or a robot, without display or GPU\n\n"
      "Example:  twinarm render assets/scenes/incline.toml --png incline.png --show "
      "forces,contacts");
  add_robot_options(*render, options.robot, "a recording, a scene in TOML, or a robot's URDF");
  render->add_option("--png", options.png, "write one picture to this file");
  render->add_option("--frames", options.frames, "write a film as numbered PNG into this folder");
  render->add_option("--mp4", options.mp4, "write a film (needs the program ffmpeg)");
  render->add_option("--gif", options.gif, "likewise, as GIF");
  render->add_option(
      "--at", options.at,
      "seconds, of the picture; if not given the end of a recording, else the start");
  render->add_option("--from", options.from, "seconds, where the film begins");
  render->add_option("--to", options.to, "seconds, where it ends");
  render->add_option("--slow", options.slow, "times slower than life")->capture_default_str();
  render->add_option("--fps", options.fps, "pictures per second; 30 if not given, of a GIF 25");
  render->add_option("--size", options.size, "in pixels")->capture_default_str();
  render
      ->add_option("--camera", options.camera,
                   "auto, front, side, top, iso, follow:BODY, or AZIMUTH,ELEVATION[,DISTANCE] in "
                   "degrees and metres")
      ->capture_default_str();
  render
      ->add_option("--show", options.show,
                   "none, all, or some of: ghost trails couplings contacts forces gravity joints "
                   "frames com momentum inertia articulated labels energy")
      ->capture_default_str();
  render
      ->add_option("--plot", options.plot,
                   "curves under the picture: none, or some of energy forces couples contacts lag")
      ->capture_default_str();
  render->add_option("--beside", options.beside,
                     "a second recording, in sync at the right of the first");
  render->add_option("--quality", options.quality, "draft, normal or studio")
      ->capture_default_str();
  render->add_option("--background", options.background, "studio, sky or white")
      ->capture_default_str();
  render->add_option("--gl", options.gl, "what paints: osmesa or egl")->capture_default_str();
  render->add_flag("--json", options.json, "print one JSON object on stdout");
  render->callback([&] { command = [&] { return run_render(options); }; });
}

void add_compare(CLI::App& app, CompareOptions& options, std::function<int()>& command) {
  CLI::App* compare = app.add_subcommand(
      "compare",
      "Run cases whose outcome is known, and tell how far off this solver is\n\n"
      "Example:  twinarm compare A1 B --integrator rk4,verlet --step 0.001,0.002");
  compare->add_option(
      "case", options.cases,
      "names; E1 also means E1-.., E all of E, joints that group; all if not given");
  std::string names;
  for (const IntegratorFacts& facts : all_integrators) names += std::string(" ") + facts.name;
  compare->add_option("--group", options.group, "all cases of this group");
  compare
      ->add_option("--integrator", options.integrators,
                   "run known motions with these beside: name,name,..; of" + names)
      ->delimiter(',')
      ->allow_extra_args(false);
  compare->add_option("--step", options.steps, "and with these steps: h1,h2,.. [s]")
      ->delimiter(',')
      ->allow_extra_args(false);
  compare->add_option("--html", options.html,
                      "folder for the page compare.html: statements, figures, code of all cases");
  compare->add_flag("--json", options.json, "print one JSON object on stdout");
  compare->callback([&] { command = [&] { return run_compare(options); }; });
}

void add_map(CLI::App& app, MapOptions& options, std::function<int()>& command) {
  CLI::App* map = app.add_subcommand(
      "map",
      "A plane of two numbers of a scene: stable or not, errors, energy; each cell is a run\n\n"
      "Example:  twinarm map assets/scenes/tracking_map.toml --x "
      "coupling.stiffness:1e4:1e6:64:log --y step:1e-3:1e-2:64:log --svg map.svg");
  map->add_option("scene", options.scene, "a scene in TOML; with --merge it may be left out");
  map->add_option(
      "--x", options.x,
      "PATH:FROM:TO:N[:log]: a number of the scene file, its range, and how many cells");
  map->add_option("--y", options.y, "likewise, upward");
  map->add_option("--measure", options.measure, "stable max_error mean_error energy passivity")
      ->capture_default_str();
  map->add_option("--of", options.of, "the coupling whose joints' errors are measured; the first");
  map->add_option("--duration", options.duration,
                  "seconds; if not given, as long as the scene says");
  map->add_option("--step", options.step, "seconds; the scene's if not given");
  map->add_option("--integrator", options.integrator, "the scene's if not given");
  map->add_option("--svg", options.svg, "write a picture with the limits of theory on top");
  map->add_option("--png", options.png, "likewise, in pixels");
  map->add_option("--csv", options.csv, "write a row for each cell, with all measures");
  map->add_option("--work", options.work,
                  "the file that keeps what is finished, and from which a killed map goes on; "
                  "below out/map if not given");
  map->add_option("--tiles", options.tiles, "how many machines share the map");
  map->add_option("--tile", options.tile, "which part this one computes, from 0; no picture");
  map->add_option("--merge", options.merge, "join these files of --tile");
  map->add_option("--cell", options.cell, "IX,IY: open a cell, from 0");
  map->add_option("--record", options.record, "of that cell: its recording; its scene goes beside");
  map->add_flag("--alone", options.alone,
                "run each cell by itself, as simulate does, where cells could run side by side");
  map->add_option("--threads", options.threads, "all processors if not given");
  map->add_flag("--force", options.force, "write over files that are there");
  map->add_flag("--json", options.json, "print one JSON object on stdout");
  map->callback([&] { command = [&] { return run_map(options); }; });
}

// The first word, where it is meant to be a command and is none.
void check_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return;
  throw InputError({{"", 0, "command line", fmt::format("there is no command '{}'", argv[1]),
                     name_remedy(argv[1], names, "commands")}});
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"twinarm: a glass-box multibody laboratory\n\nExample:  twinarm study"};
  app.require_subcommand(1);
  DynamicsOptions dynamics;
  InspectOptions inspect;
  ModesOptions modes;
  CouplingPredictOptions predicted;
  CouplingGainsOptions gains;
  SimulateOptions simulate;
  simulate.command.assign(argv, argv + argc);
  inspect.command = simulate.command;
  ExportOptions exported;
  ReplayOptions replayed;
  RenderOptions render;
  CompareOptions compare;
  MapOptions map;
  StudyOptions study;
  TraceOptions trace;
  std::string recipe;
  std::function<int()> command;
  add_dynamics(app, dynamics, command);
  add_inspect(app, inspect, command);
  add_modes(app, modes, command);
  add_coupling(app, predicted, gains, command);
  add_simulate(app, simulate, command);
  add_recordings(app, exported, replayed, command);
  add_render(app, render, command);
  add_compare(app, compare, command);
  add_map(app, map, command);
  add_study(app, study, command);
  add_make_robot(app, recipe, command);
  add_trace(app, trace, command);
  const bool as_json =
      std::any_of(argv, argv + argc, [](std::string_view word) { return word == "--json"; });
  try {
    check_command(app, argc, argv);
    app.parse(argc, argv);
  } catch (const InputError& error) {
    return tell(error, as_json);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    return tell(InputError({{"", 0, "command line", error.what(), "see twinarm --help"}}), as_json);
  }

  catch_interrupts();
  try {
    return command();
  } catch (const InputError& error) {
    return tell(error, as_json);
  } catch (const Interrupted&) {
    fmt::print(stderr, "twinarm: interrupted; nothing half-written was left behind\n");
    return kInterrupted;
  } catch (const std::exception& error) {
    fmt::print(stderr, "twinarm: internal fault: {}\n", error.what());
    return kInternal;
  }
}
