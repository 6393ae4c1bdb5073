// `twinarm study`: runs the paper's experiments and writes a report (docs/use/run_the_study.md).
#include <fmt/format.h>

#include "app/command/command.h"
#include "app/device/devices.h"
#include "app/page/pages.h"
#include "app/plot/gnuplot.h"
#include "app/servo/servo_loop.h"
#include "app/study/calibration/calibration.h"
#include "app/study/findings/findings.h"
#include "app/study/report/report.h"
#include "app/support/files.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "coupling/device/device_motion.h"
#include "coupling/target/synthetic_operator.h"
#include "solver/support/atomic_file.h"
#include "solver/support/diagnostics.h"
#include "solver/support/input_file.h"

namespace twinarm {
namespace {

struct StudyOptions {
  std::filesystem::path out = "out/study";
  // "synthetic", "trace", or a device (app/device/devices.h); empty: the trace, if one is given
  std::string device;
  std::optional<unsigned> seed;  // default: the settings' seed
  std::filesystem::path trace;
  bool recalibrate = false, identify = false, paper_view = false, json = false;
  std::filesystem::path assets;  // empty: found beside the program
  std::string identify_one;      // "ROW/LAW/RATE": only this identification, and no study
};

void add_options(const OptionAdder& add, StudyOptions& options) {
  add.group("Operator motion of E1 and E2");
  add("--device", options.device,
      "synthetic, trace, or a device of `twinarm hand --device list`; default: the trace if one is "
      "given, else synthetic");
  add("--seed", options.seed, "random seed of the synthetic motion; default: the settings'");
  add.input("--trace", options.trace, "", "recorded operator motion (CSV)");
  add.group("Calibration");
  add("--recalibrate", options.recalibrate,
      "re-run the gain calibration and overwrite study/calibration.json of the assets (5 min)");
  add("--identify", options.identify,
      "re-run the parameter identification of Table 2 and overwrite study/identification.json of "
      "the assets (10 min)");
  add("--identify-one", options.identify_one,
      "ROW/LAW/RATE: print one identification as JSON and stop; ROW is E3, E4 or E4-text, RATE in "
      "Hz: E4/linear/60");
  add.group("Output");
  add.output("--out", options.out, "", "folder for report, figures, CSV");
  add("--paper-view", options.paper_view, "hide the target robot in pictures, as the paper does");
  add.json(options.json);
  add.assets(options.assets);
}

// Records a device for the duration of the synthetic motion, as OUT/hand.csv, a valid trace.
std::unique_ptr<OperatorMotion> record_device(const StudyOptions& options,
                                              const StudySettings& settings) {
  const std::unique_ptr<InputDevice> device = open_device(options.device);
  const bool real_time = !options.device.starts_with("virtual");
  make_folder(options.out);
  Progress progress(options.json);
  progress.stage("recording " + device->description(), 1);
  const double duration = settings.operator_duration;
  auto hand = record_operator(*device, duration, real_time,
                              [&](double t) { progress.advance(t, duration); });
  progress.finish();
  write_device_log(*hand, options.out / "hand.csv");
  return hand;
}

bool is_device(const StudyOptions& options) {
  return !options.device.empty() && options.device != "synthetic" && options.device != "trace";
}

std::unique_ptr<OperatorMotion> operator_motion(const StudyOptions& options,
                                                const StudySettings& settings) {
  if (options.device == "trace" && options.trace.empty())
    throw InputError("--device trace", "no trace is given", "add --trace FILE.csv",
                     "option.missing");
  if (!options.device.empty() && options.device != "trace" && !options.trace.empty())
    throw InputError("--trace", "cannot be combined with --device " + options.device,
                     "leave --device out, or give --device trace", "option.conflict");
  if (is_device(options)) return record_device(options, settings);
  if (!options.trace.empty()) return recorded_motion(options.trace);
  return std::make_unique<SyntheticOperator>(options.seed.value_or(settings.seed),
                                             settings.operator_duration, settings.operator_ranges);
}

StudyOperator scene_operator(const StudyOptions& options, const StudySettings& settings,
                             const OperatorMotion& hand) {
  if (!options.trace.empty()) return traced_operator(hand, options.trace);
  if (is_device(options)) return traced_operator(hand, options.out / "hand.csv");
  return synthetic_study_operator(hand, options.seed.value_or(settings.seed),
                                  settings.operator_ranges);
}

StudyResults compute(const StudyOptions& options, const Words& typed, const StudyInputs& inputs,
                     const OperatorMotion& hand, const Calibration& calibration,
                     Progress& progress) {
  StudyResults results;
  results.calibration = calibration;
  results.operator_description = hand.description();
  results.command = command_line(typed);
  results.settings_text = read_whole_file(inputs.settings.assets / "study" / "settings.toml");
  results.arm2_mass_scale = calibration.entry("chosen").numbers.at("arm2_mass_scale");
  for (const LinkDescription& link : inputs.s103.links)
    results.link_masses.emplace_back(link.name, link.mass);
  results.search_rates = inputs.settings.search_rates_hz;
  results.identifications =
      read_identifications(inputs.settings.assets / "study" / "identification.json");

  const StudyRobot robot = StudyRobot::s103(inputs.settings, inputs.s103, results.arm2_mass_scale);
  progress.stage("E1 to E4", 0.02);
  results.reproduction = run_reproduction(robot, calibration, hand);
  progress.stage("E1 and E2 with many operators", 0.15);
  results.ensembles = run_ensembles(inputs, robot, calibration,
                                    options.seed.value_or(inputs.settings.seed), progress);
  progress.stage("variants: gains by trial, matched, implicit, held, ablations", 0.18);
  results.variants = run_variants(inputs, robot, calibration, progress);
  progress.stage("findings", 0.15);
  derive_findings(inputs, results, progress);
  progress.stage("evidence: all fits against all that the paper says", 0.1);
  results.evidence = weigh_evidence(inputs, results, progress);
  results.answer = answer_in_words(results);
  progress.stage("obstacle", 0.1);
  results.obstacle = run_obstacles(inputs, robot, calibration);
  progress.stage("recordings", 0.1);
  results.recordings =
      write_recordings(inputs, robot, scene_operator(options, inputs.settings, hand), results,
                       options.out / "recordings", progress);
  progress.stage("pictures", 0.2);
  paint_pictures(results, options.out / "pictures", options.paper_view, progress);
  return results;
}

void print_summary(const StudyResults& results, const std::filesystem::path& report) {
  fmt::print("\nTable 2, in degrees: measured (published)\n\n");
  fmt::print("{:24}", "");
  for (const RunResult& result : results.reproduction) fmt::print("{:>18}", result.spec.name);
  // The four numbers of a row, as numbers_of() orders them.
  const char* const titles[] = {"maximum, joint 1", "maximum, joint 2", "mean, joint 1",
                                "mean, joint 2"};
  for (std::size_t i = 0; i < std::size(titles); ++i) {
    fmt::print("\n  {:22}", titles[i]);
    for (const RunResult& result : results.reproduction)
      fmt::print("{:>18}", fmt::format("{:.2f} ({:.1f})", numbers_of(result)[i],
                                       numbers_of(kPaperTable.at(result.spec.name))[i]));
  }
  fmt::print(
      "\n\n  E3, E4: calibrated gains. E1, E2: the same gains, with another operator motion than "
      "the paper's ({}).\n\n",
      results.operator_description);
  for (const Ensemble& all : results.ensembles) {
    fmt::print("  {} with {} operators: median (10 to 90 %), published at percentile\n", all.name,
               all.seeds);
    for (const auto& [row, values] : {std::pair{"maximum", &all.max_deg}, {"mean", &all.mean_deg}})
      for (std::size_t j = 0; j < 2; ++j) {
        const Distribution& number = (*values)[j];
        fmt::print("    {}, joint {}: {:.2f} ({:.2f} to {:.2f}), {:.0f} %\n", row, j + 1,
                   number.median, number.p10, number.p90, number.percentile);
      }
  }
  fmt::print("\n");
  for (const std::string& sentence : results.answer) fmt::print("{}\n", sentence);
  fmt::print("\nReport: {}  ({:.0f} s)\n", report.string(), results.seconds);
}

int run_study(const StudyOptions& options, const Words& typed) {
  const double start = steady_seconds();
  const std::filesystem::path assets = find_assets(options.assets);
  if (!options.identify_one.empty()) {
    fmt::print("{}\n", answer_json(identify_one(load_inputs(assets), options.identify_one)));
    return 0;
  }
  const std::filesystem::path calibration_file = assets / "study" / "calibration.json";
  StudyInputs inputs;
  std::unique_ptr<OperatorMotion> hand;
  Calibration calibration;
  DiagnosticList faults;  // of all inputs, reported together before anything is written
  attempt(faults, [&] { inputs = load_inputs(assets); });
  attempt(faults, [&] { hand = operator_motion(options, inputs.settings); });
  if (!options.recalibrate)
    attempt(faults, [&] { calibration = read_calibration(calibration_file); });
  attempt(faults, [&] { require_writable_folder(options.out); });
  attempt(faults, require_gnuplot);
  faults.check();
  if (options.recalibrate) {
    Progress progress(false);
    calibration = calibrate(inputs, progress);
    write_calibration(calibration, calibration_file);
  }
  if (options.identify) {
    Progress progress(false);
    const std::vector<Identification> found = identify(inputs, progress);
    write_identifications(found, assets / "study" / "identification.json");
    progress.finish();
  }
  for (const char* part : {"figures", "csv", "pictures", "recordings"})
    make_folder(options.out / part);

  Progress progress(false);
  StudyResults results = compute(options, typed, inputs, *hand, calibration, progress);
  progress.stage("figures and report", 0.15);
  write_figures(results, options.out / "figures");
  progress.advance(0.6);
  write_csv(results, options.out / "csv");
  results.seconds = steady_seconds() - start;
  write_report(results, assets, options.out);
  const std::filesystem::path report = options.out / "report.html";
  const std::string as_json = study_json(results, report.string());
  write_whole_file(options.out / "study.json", as_json + "\n");
  progress.finish();
  if (options.json)
    fmt::print("{}\n", as_json);
  else
    print_summary(results, report);
  return 0;
}

}  // namespace

Command study_command() {
  return {140, "study",
          "Run the experiments E1 to E4 of the paper, their analysis, and write a report\n\n"
          "Examples:\n"
          "  twinarm study --out out/study\n"
          "  twinarm study --trace hand.csv --out out/my_operator",
          add_options, run_study};
}

}  // namespace twinarm
