// The commands of the program: options in, exit code out (docs/command_line.md). They throw
// InputError for bad input and Interrupted after Ctrl-C; main() tells.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/film/render_options.h"
#include "app/inspect/report/inspect_options.h"
#include "app/map/map_options.h"
#include "app/robot/robot_input.h"
#include "app/run/simulate_options.h"
#include "app/support/find_assets.h"
#include "app/zwidth/zwidth_options.h"

namespace twinarm {

struct StudyOptions {
  std::filesystem::path out = "out/study";
  // "synthetic", "trace", or a device (app/device/devices.h); empty: a trace if one is given
  std::string device;
  std::optional<unsigned> seed;  // left out: the settings' seed
  std::filesystem::path trace;
  bool recalibrate = false, identify = false, paper_view = false, json = false;
  std::filesystem::path assets;  // empty: found beside the program
  std::string ask;               // "ROW/LAW/RATE": only this question of Table 2, and no study
};
int run_study(const StudyOptions& options);

int run_make_robot(const std::filesystem::path& recipe);

struct TraceOptions {
  unsigned seed = 1;
  double duration = 20, rate = 200;  // [s], [Hz]
  std::filesystem::path out;
};
int run_trace(const TraceOptions& options);

struct DynamicsOptions {
  RobotOptions robot;
  bool json = false;
};
int run_dynamics(const DynamicsOptions& options);

int run_inspect(const InspectOptions& options);  // 1 where a check falls short

struct ModesOptions {
  RobotOptions robot;
  bool json = false;
};
int run_modes(const ModesOptions& options);

struct CouplingPredictOptions {
  RobotOptions robot;  // its model: a scene; or a URDF, with one coupling in words
  std::string type = "linear", link, point, measure, treatment;  // as in a scene; point "x,y,z"
  std::optional<double> stiffness, damping;
  std::optional<double> step;   // [s]; left out: the scene's
  std::string integrator;       // empty: the scene's
  double turn = 180, time = 1;  // of the target [deg, or mm], [s]
  std::optional<double> wall;   // [N/m]
  std::string along;            // "j1=1,j2=-0.5": parts of that move; empty: 1 of each joint
  bool json = false;
};
int run_coupling_predict(const CouplingPredictOptions& options);

struct CouplingGainsOptions {
  RobotOptions robot;  // its model: a scene; empty: gains from the options below
  std::optional<double> frequency, damping_ratio;  // [Hz], 1
  std::optional<double> stiffness, inertia;
  double damping = 0;
  std::string solref, impedance;  // "a,b"; "d" or "d,dmax"
  bool json = false;
};
int run_coupling_gains(const CouplingGainsOptions& options);

int run_simulate(const SimulateOptions& options);

struct HandOptions {
  std::filesystem::path scene;
  std::string device = "virtual:synthetic";  // app/device/devices.h
  std::string mapping = "paper";
  std::optional<double> scale, force_scale;  // of the mapping
  std::optional<double> duration, step;      // [s]; left out: until Ctrl-C, the scene's
  bool simulated = false, fifo = false, control = false, picture = false, record = false;
  std::filesystem::path out = "out/hand";
  bool json = false;
};
int run_hand(const HandOptions& options);  // 3 where the robot left all bounds

struct LabOptions {
  std::filesystem::path scene;  // empty: the first of the gallery
  std::string lanes;            // "integrator=semi-implicit,rk4"; empty: as the gallery says
  std::string listen = "127.0.0.1";
  int port = 0;        // 0: any that is free
  int remember = 256;  // of a run [MB]
  bool no_browser = false, json = false;
};
int run_lab(const LabOptions& options);

struct TrialOptions {
  std::string device = "keyboard", mapping = "paper";
  std::string conditions = "torsional,linear,kinematic", tasks = "free,pick-and-place";
  std::string subject;             // empty: the next free code
  std::optional<unsigned> seed;    // of the order; left out: as given
  double seconds = 20, most = 60;  // of free motion; of a pick-and-place [s]
  bool feel = false;               // the force on the hand; the paper has none
  bool yes = false, simulated = false, json = false;
  std::filesystem::path out = "out/trial", assets;
};
int run_trial(const TrialOptions& options);

struct ExportOptions {
  std::filesystem::path recording;
  std::filesystem::path page;  // an HTML file with all of the run; empty: text on stdout
  bool json = false, csv = false;
};
int run_export(const ExportOptions& options);

struct ReplayOptions {
  std::filesystem::path recording;
  std::optional<double> from;  // [s]; left out: the first that is recorded
  std::vector<std::string> changes;
  std::filesystem::path plot;  // SVG; empty: none
  bool json = false;
};
int run_replay(const ReplayOptions& options);  // 1 where a bit differs from the recording

int run_render(const RenderOptions& options);

int run_map(const MapOptions& options);

int run_zwidth(const ZwidthOptions& options);

struct CompareOptions {
  std::vector<std::string> cases;
  std::string group;
  std::vector<std::string> integrators;
  std::vector<double> steps;
  std::filesystem::path html;  // folder or .html file of the page; empty: none
  bool json = false;
};
int run_compare(const CompareOptions& options);  // 1 where a case falls short

}  // namespace twinarm
