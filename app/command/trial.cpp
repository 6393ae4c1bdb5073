// `twinarm trial`: runs a user study (docs/use/user_study.md).
#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <random>
#include <thread>

#include "app/command/command.h"
#include "app/device/devices.h"
#include "app/study/calibration/calibration.h"
#include "app/study/findings/findings.h"
#include "app/study/study_run.h"
#include "app/support/files.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "app/trial/trial.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

struct TrialOptions {
  std::string device = "keyboard", mapping = "paper";
  std::string conditions = "torsional,linear,kinematic", tasks = "free,pick-and-place";
  std::string participant;               // empty: the next free code
  std::optional<unsigned> seed;          // of the order of conditions; default: as given
  double seconds = 20, time_limit = 60;  // free motion; limit of pick-and-place [s]
  bool force_feedback = false;           // force feedback; the paper has none
  bool yes = false, simulated = false, json = false;
  std::filesystem::path out = "out/trial", assets;
};

void add_options(const OptionAdder& add, TrialOptions& options) {
  add.group("Device");
  add("--device", options.device, "input device, as in `twinarm hand --device list`");
  add("--mapping", options.mapping, "device to joints: paper (theta1, 4, 6) or arm (theta1, 2, 3)");
  add("--force-feedback", options.force_feedback,
      "force feedback, on a device with motors (the paper has none)");
  add("--simulated", options.simulated, "run without countdown and pacing, for a virtual device");
  add.group("Protocol");
  add("--conditions", options.conditions, "conditions, in this order");
  add("--tasks", options.tasks, "tasks for each condition");
  add("--seed", options.seed, "randomise the order of the conditions with this seed");
  add("--participant", options.participant,
      "anonymous code of the participant; default: S1, S2, ...");
  add("--seconds", options.seconds, "duration of free motion [s]")->check(above_zero());
  add("--time-limit", options.time_limit, "time limit of pick-and-place [s]")->check(above_zero());
  add("--yes", options.yes, "start without waiting for Enter");
  add.group("Output");
  add.output("--out", options.out, "", "folder of results.csv and of the logs");
  add.json(options.json);
  add.assets(options.assets);
}

const std::vector<std::string> kConditions{"torsional", "linear", "kinematic"};
const std::vector<std::string> kTasks{"free", "pick-and-place"};

// The words of a list, each one of `known`.
std::vector<std::string> read_words(const std::string& text, const std::vector<std::string>& known,
                                    const char* option, DiagnosticList& faults) {
  std::vector<std::string> words = split(text);
  for (const std::string& word : words) choose(option, word, known, "possible", faults);
  for (const std::string& word : known)
    if (std::ranges::count(words, word) > 1)
      faults.add(option, "'" + word + "' is given twice", "give each once", "option.twice");
  return words;
}

// Scenes of the paper's experiments with the device as input. The kinematic condition shows the
// target robot of the torsional one.
std::vector<TrialCondition> write_conditions(const std::vector<std::string>& names,
                                             const std::filesystem::path& assets,
                                             const std::filesystem::path& folder) {
  const StudyInputs inputs = load_inputs(assets);
  const Calibration calibration = read_calibration(assets / "study" / "calibration.json");
  const StudyRobot robot = StudyRobot::s103(
      inputs.settings, inputs.s103, calibration.entry("chosen").numbers.at("arm2_mass_scale"));
  const std::vector<RunSpec> specs = reproduction_specs(calibration);
  std::vector<TrialCondition> conditions;
  for (const std::string& name : names) {
    const RunSpec& spec = specs[name == "linear" ? 1 : 0];
    TrialCondition condition;
    condition.name = name;
    condition.is_kinematic = name == "kinematic";
    condition.title = condition.is_kinematic ? "the robot follows your hand exactly"
                      : name == "linear"     ? "linear springs pull the robot to your hand"
                                             : "torsional springs pull the robot to your hand";
    condition.scene = folder / (name + ".toml");
    write_whole_file(condition.scene,
                     scene_text({&inputs.settings, &robot, spec, device_operator(), nullptr}));
    conditions.push_back(std::move(condition));
  }
  return conditions;
}

// A random order for each seed, so that practice does not favour one condition. (std::shuffle
// differs between standard libraries.)
template <class T>
void shuffle(std::vector<T>& items, unsigned seed) {
  std::mt19937 engine(seed);
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[engine() % i]);
}

const char* instructions(bool pick) {
  return pick ? "Move the object (o) into the brackets [ ]: go to it, hold the button, release it "
                "at "
                "the goal. As fast as you can."
              : "Move freely in all directions, slowly and fast.";
}

// Returns false at the end of the input.
bool wait_for_enter() {
  std::string line;
  if (std::getline(std::cin, line)) return true;
  check_interrupt();  // Ctrl-C ends the reading too
  return false;
}

void count_down() {
  for (int n = 3; n > 0; --n) {
    print_error("{} ", n);
    for (int i = 0; i < 10; ++i) {
      check_interrupt();
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  print_error("go!\n");
}

// Draws each picture over the last one.
class TerminalShow {
 public:
  explicit TerminalShow(double seconds) : seconds_(seconds) {}
  void operator()(const std::string& picture, double t) {
    if (lines_ > 0) print_error("\x1b[{}A", lines_);
    print_error("{}{:5.1f} s of {:.0f}   # robot  . your hand  o object  [ ] goal\n", picture, t,
                seconds_);
    lines_ = static_cast<int>(std::ranges::count(picture, '\n')) + 1;
  }

 private:
  double seconds_;
  int lines_ = 0;
};

struct Step {
  const TrialCondition* condition;
  bool pick;
};

TrialResult run_step(const TrialOptions& options, const MappingSpec& mapping, const Step& step,
                     const std::filesystem::path& folder) {
  TrialTask task;
  task.is_pick_and_place = step.pick;
  task.seconds = step.pick ? options.time_limit : options.seconds;
  task.real_time = !options.simulated;
  const bool is_shown = !options.simulated && isatty(STDERR_FILENO) != 0;
  if (!options.simulated) {
    print_error("\n{}: {}.\n{}\n", step.condition->name, step.condition->title,
                instructions(step.pick));
    if (!options.yes) {
      print_error("Press Enter when you are ready. ");
      if (!wait_for_enter()) {
        print_error("\n");
        throw InputError("trial", "cannot wait for Enter: there is no terminal",
                         "run it in a terminal, or give --yes", "trial.no-terminal");
      }
    }
    count_down();
  }
  if (is_shown) task.show = TerminalShow(task.seconds);
  const std::unique_ptr<InputDevice> device = open_device(options.device);
  const std::string name = step.condition->name + (step.pick ? "_pick" : "_free");
  return run_task(*step.condition, *device, mapping, task, folder / (name + ".csv"));
}

int run_trial(const TrialOptions& options) {
  DiagnosticList faults;
  const auto names = read_words(options.conditions, kConditions, "--conditions", faults);
  const auto tasks = read_words(options.tasks, kTasks, "--tasks", faults);
  MappingSpec mapping;
  if (const auto kind = choose("--mapping", options.mapping, {"paper", "arm"}, "mappings", faults))
    mapping.kind = static_cast<MappingKind>(*kind);
  mapping.force_scale = options.force_feedback ? 1 : 0;
  if (options.simulated && !options.device.starts_with("virtual"))
    faults.add("--simulated", "needs a virtual device",
               "leave it out, or give --device virtual:HAND", "option.conflict");
  if (!std::ranges::all_of(options.participant, [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_';
      }))
    faults.add("--participant",
               "'" + options.participant + "' has characters other than letters, digits, - and _",
               "give a code such as S7: it names a folder in --out", "option.form");
  faults.check();

  open_device(options.device);  // its errors are reported before the participant waits
  TrialReport report;
  report.csv = (options.out / "results.csv").string();
  const std::string next = next_participant(report.csv);
  report.participant = options.participant.empty() ? next : options.participant;
  report.mapping = options.mapping;
  report.device = options.device;
  const std::filesystem::path folder = options.out / report.participant;
  const std::vector<TrialCondition> conditions =
      write_conditions(names, find_assets(options.assets), folder);
  std::vector<Step> steps;
  for (const std::string& task : tasks) {
    std::vector<Step> round;
    for (const TrialCondition& condition : conditions)
      round.push_back({&condition, task == "pick-and-place"});
    if (options.seed) shuffle(round, *options.seed);
    steps.insert(steps.end(), round.begin(), round.end());
  }
  for (const Step& step : steps) {
    report.results.push_back(run_step(options, mapping, step, folder));
    add_last_to_csv(report, report.csv);  // kept if a later task fails
    if (is_interrupted()) break;
  }
  fmt::print("{}", options.json ? trial_json(report) + "\n" : "\n" + trial_table(report) + "\n");
  std::vector<std::filesystem::path> files{report.csv};
  for (const TrialCondition& condition : conditions) files.push_back(condition.scene);
  for (const TrialResult& result : report.results) files.emplace_back(result.log);
  print_wrote(files, options.json);
  check_interrupt();
  return 0;
}

}  // namespace

Command trial_command() {
  return {80, "trial",
          "Run a user study: free motion and pick-and-place under three couplings\n\n"
          "Examples:\n"
          "  twinarm trial --device gamepad --seed 7\n"
          "  twinarm trial --device virtual:synthetic --simulated --yes",
          add_options, run_trial};
}

}  // namespace twinarm
