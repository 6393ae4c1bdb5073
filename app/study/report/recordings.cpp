#include "app/study/report/report.h"

#include "app/film/rendering.h"
#include "app/page/pages.h"
#include "app/record/record_run.h"
#include "app/web/web_bundle.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

// Records the scene; returns the largest difference of an angle from the study's [deg], which are
// given by joint and step.
double record(const std::filesystem::path& scene, const std::filesystem::path& file,
              const std::vector<std::string>& joints,
              const std::vector<std::vector<double>>& angles) {
  SimulateOptions options;
  options.robot.model = scene;
  options.record = file;
  SimulatePlan prepared = prepare_simulation(options);
  prepared.run.times.clear();
  const Model<double>& model = prepared.input.robot.model;
  double largest = 0;
  RunWatch watch;
  watch.look = [&](SteppedRun& run) {
    const auto step = static_cast<std::size_t>(run.step());
    for (std::size_t j = 0; j < angles.size(); ++j) {
      if (step >= angles[j].size()) continue;
      const auto body = static_cast<std::size_t>(model.find_joint(joints[j]));
      const double q = run.simulation().state().q[model.iq[body]];
      largest = std::max(largest, std::abs(q / kDegree - angles[j][step]));
    }
  };
  watch.tick = [](double) { check_interrupt(); };
  try {
    record_plan(options, prepared, watch);
  } catch (const Interrupted&) {  // removes the partial recording
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    throw;
  }
  return largest;
}

// Time of the largest error of joints 1 and 2.
double time_of_largest_error(const TrackingSeries& series) {
  double largest = 0, at = 0;
  for (std::size_t n = 0; n < series.t.size(); ++n)
    for (std::size_t j = 0; j < 2; ++j)
      if (const double error = std::abs(series.q_K[j][n] - series.q_D[j][n]); error > largest) {
        largest = error;
        at = series.t[n];
      }
  return at;
}

}  // namespace

std::vector<StudyRecording> write_recordings(const StudyInputs& inputs, const StudyRobot& robot,
                                             const StudyOperator& hand, const StudyResults& results,
                                             const std::filesystem::path& folder,
                                             Progress& progress) {
  std::vector<StudyRecording> all;
  const auto add = [&](const StudyScene& scene, const std::vector<std::vector<double>>& angles) {
    StudyRecording& made = all.emplace_back();
    made.name = scene.spec.name;
    made.title = scene.spec.title;
    made.scene = folder / (made.name + ".toml");
    made.recording = folder / (made.name + ".twinrec");
    write_whole_file(made.scene, scene_text(scene));
    made.apart_deg = record(made.scene, made.recording, robot.joints().turned, angles);
    if (web_bundle().replay.empty()) return;
    made.page = folder / (made.name + ".html");
    write_whole_file(made.page, replay_page(made.recording).html);
  };
  StudyScene scene{&inputs.settings, &robot, {}, {}};
  const std::size_t count = results.reproduction.size() + results.obstacle.size();
  for (const RunResult& run : results.reproduction) {
    scene.spec = run.spec;
    scene.hand = run.spec.name < "E3" ? hand : automatic_operator();
    std::vector<std::vector<double>> angles;
    for (const auto& q : run.series.q_D) angles.push_back(in_degrees(q));
    add(scene, angles);
    progress.advance(all.size(), count);
  }
  scene.hand = automatic_operator();
  for (const ObstacleRun& run : results.obstacle) {
    scene.spec = run.spec;
    scene.obstacle = run.obstacle;
    add(scene, {run.q_D_deg.begin(), run.q_D_deg.end()});
    progress.advance(all.size(), count);
  }
  return all;
}

void paint_pictures(const StudyResults& results, const std::filesystem::path& folder,
                    bool paper_view, Progress& progress) {
  // At the end of the first sweep the KVR is deepest in the box.
  constexpr double kStopped = 0.952, kAnyPose = 0.3;
  const char* const kFromLeft = "-60,30,2.3";
  const char* const kFaceOfBox = "30,26,2.75";
  const double e3 = time_of_largest_error(results.reproduction.at(2).series);
  const double e4 = time_of_largest_error(results.reproduction.at(3).series);
  const std::vector<std::tuple<const char*, const char*, double, const char*>> pictures{
      {"robot", "E4", kAnyPose, "-52,22,2.35"},
      {"E3", "E3", e3, kFromLeft},
      {"E4", "E4", e4, kFromLeft},
      {"obstacle-linear", "obstacle_linear", kStopped, kFaceOfBox},
      {"obstacle-torsional", "obstacle_torsional", kStopped, kFaceOfBox}};
  std::size_t done = 0;
  for (const auto& [name, run, time, camera] : pictures) {
    const auto made = std::ranges::find_if(
        results.recordings, [run = run](const StudyRecording& r) { return r.name == run; });
    const bool portrait = name == std::string("robot");
    RobotOptions options;
    options.model = made->recording;
    FilmTimes times;
    times.at = time;
    Progress quiet(true);
    FilmedRun shown = film_run(options, times, camera, quiet);
    PictureWish wish;
    wish.width =
        portrait ? 1280 : 960;  // 960: the width of the page, so that texts keep their size
    wish.height = wish.width * 9 / 16;
    if (portrait) wish.quality = Quality::studio;
    wish.camera = camera;
    if (!portrait && !paper_view) wish.overlays = {"targets", "couplings"};
    write_png((folder / (std::string(name) + ".png")).string(), Rendering(wish, {&shown}).paint(0));
    progress.advance(++done, pictures.size());
  }
}

}  // namespace twinarm
