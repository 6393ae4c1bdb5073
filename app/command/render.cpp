// `twinarm render`: pictures and videos of a recording, a scene or a robot.
#include <fmt/format.h>

#include "app/command/command.h"
#include "app/data/json_writer.h"
#include "app/draw/overlays/overlays.h"
#include "app/film/filmed_run.h"
#include "app/film/rendering.h"
#include "app/robot/robot_input.h"
#include "app/support/files.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

struct RenderOptions {
  RobotOptions robot;                           // model: a recording, a scene or a URDF
  std::filesystem::path png, frames, mp4, gif;  // exactly one of them
  std::optional<double> at, from, to;           // [s]
  std::string size = "1280x720", camera = "auto",
              show = fmt::format("{}", fmt::join(usual_overlays(Overlay::Shown::everywhere), ","));
  std::string plot = "none", quality = "normal", background = "studio", gl = "osmesa";
  std::filesystem::path side_by_side;  // a second recording; empty: none
  double slow_motion = 1;              // slow-motion factor
  std::optional<double> fov;           // [deg]
  double orbit = 0;                    // [deg/s of the video]
  std::optional<double> fps;           // default: 30, GIF 25
  bool json = false;
};

void add_options(const OptionAdder& add, RenderOptions& options) {
  add.robot(options.robot, "recording, scene (TOML) or robot (URDF)");
  add.group("Output (one of)");
  add.output("--png", options.png, ".png", "write one picture to this file");
  add.output("--frames", options.frames, "",
             "write a video as numbered PNG files into this folder");
  add.output("--mp4", options.mp4, ".mp4", "write an MP4 video (needs ffmpeg)");
  add.output("--gif", options.gif, ".gif", "write an animated GIF (needs ffmpeg)");
  add.group("Time");
  add("--at", options.at, "time of the picture [s]; default: end of a recording, else the start");
  add("--from", options.from, "start of the video [s]; default: the start");
  add("--to", options.to, "end of the video [s]; default: the end");
  add("--slow-motion", options.slow_motion, "slow-motion factor");
  add("--fps", options.fps, "frames per second; default 30, GIF 25");
  add.group("Content");
  add("--camera", options.camera,
      "auto, front, side, top, iso, follow:BODY, or AZIMUTH,ELEVATION[,DISTANCE] [deg, m]");
  add("--fov", options.fov, "vertical field of view [deg]; default 31.5")->check(between(1, 120));
  add("--orbit", options.orbit,
      "rate at which the camera of a video turns about the vertical [deg/s]")
      ->check(between(-360, 360));
  add("--show", options.show,
      fmt::format("none, all, or some of: {}", fmt::join(parse_overlays("all"), ", ")));
  add("--plot", options.plot,
      "curves below the picture: none, or some of: energy, forces, torques, contacts, "
      "tracking-error");
  add.input("--side-by-side", options.side_by_side, ".twinrec",
            "second recording, shown to the right of the first in sync");
  add.group("Picture");
  add("--size", options.size, "WIDTHxHEIGHT [pixels], each 16 to 8192");
  add("--quality", options.quality, "draft, normal or studio");
  add("--background", options.background, "studio, sky or white");
  add("--gl", options.gl, "OpenGL back end: osmesa or egl");
  add.json(options.json);
}

struct RenderPlan {
  PictureWish picture;
  FilmTimes times;
  std::filesystem::path file;  // or folder
  double rate = 30;            // frames per second
};

constexpr int kMaxPixels = 8192;  // along a side

bool parse_size(const std::string& text, RenderPlan& plan) {
  const auto cross = text.find('x');
  if (cross == std::string::npos) return false;
  const auto width = parse_number(text.substr(0, cross));
  const auto height = parse_number(text.substr(cross + 1));
  const auto fits = [](const std::optional<double>& n) {
    return n && *n >= 16 && *n <= kMaxPixels && *n == std::floor(*n);
  };
  if (!fits(width) || !fits(height)) return false;
  plan.picture.width = static_cast<int>(*width);
  plan.picture.height = static_cast<int>(*height);
  return true;
}

template <class T>
void choose_word(const char* option, const std::string& word, const std::vector<std::string>& names,
                 const std::vector<T>& values, T& chosen, DiagnosticList& faults) {
  if (const auto found = choose(option, word, names, "possible", faults)) chosen = values[*found];
}

void check_outputs(const RenderOptions& options, RenderPlan& plan, DiagnosticList& faults) {
  int outputs = 0;
  for (const auto* file : {&options.png, &options.frames, &options.mp4, &options.gif})
    if (!file->empty()) ++outputs, plan.file = *file;
  if (outputs != 1)
    faults.add("output", outputs == 0 ? "is missing" : "more than one is given",
               "give one of --png FILE, --frames DIR, --mp4 FILE, --gif FILE", "option.outputs");
  plan.times.is_film = outputs == 1 && options.png.empty();
  if (plan.times.is_film && options.at)
    faults.add("--at", "applies to a picture only", "give --from and --to, or --png FILE",
               "option.useless");
  if (!plan.times.is_film && options.orbit != 0)
    faults.add("--orbit", "applies to a video only", "give the azimuth of a picture by --camera",
               "option.useless");
  if (!plan.times.is_film && (options.from || options.to))
    faults.add("--from", "applies to a video only", "give --at for a picture", "option.useless");
  for (const auto& [file, option] :
       {std::pair{&options.mp4, "--mp4"}, std::pair{&options.gif, "--gif"}})
    if (!file->empty()) attempt(faults, [&, name = option] { return find_ffmpeg(name); });
}

RenderPlan read_render_options(const RenderOptions& options) {
  DiagnosticList faults;
  RenderPlan plan;
  check_outputs(options, plan, faults);
  if (!parse_size(options.size, plan))
    faults.add("--size", "'" + options.size + "' is not a size",
               fmt::format("give WIDTHxHEIGHT, each from 16 to {} pixels", kMaxPixels),
               "option.form");
  choose_word<Quality>("--quality", options.quality, {"draft", "normal", "studio"},
                       {Quality::draft, Quality::normal, Quality::studio}, plan.picture.quality,
                       faults);
  choose_word<Background>("--background", options.background, {"studio", "sky", "white"},
                          {Background(), sky_background(), white_background()},
                          plan.picture.background, faults);
  choose_word<Backend>("--gl", options.gl, {"osmesa", "egl"}, {Backend::osmesa, Backend::egl},
                       plan.picture.backend, faults);
  if (auto overlays = attempt(faults, [&] { return parse_overlays(options.show); }))
    plan.picture.overlays = *overlays;
  if (auto curves = attempt(faults, [&] { return parse_curves(options.plot); }))
    plan.picture.curves = *curves;
  plan.picture.camera = options.camera;
  if (options.fov) plan.picture.field_of_view = *options.fov * kDegree;
  plan.rate = options.fps.value_or(options.gif.empty() ? 30 : 25);  // GIF: units of 1/100 s
  check_positive("--slow-motion", options.slow_motion, faults);
  if (!(plan.rate > 0 && plan.rate <= 1000))
    faults.add("--fps", "must be above 0 and at most 1000", "", "option.range");
  if (!options.side_by_side.empty() && plan.picture.width < 64)
    faults.add("--size", "is too narrow for two runs", "give a width of at least 64",
               "option.range");
  if (options.at && !(*options.at >= 0 && std::isfinite(*options.at)))
    faults.add("--at", "must be 0 s or later", "", "option.negative");
  faults.check();
  plan.picture.orbit = options.orbit * kDegree / plan.rate;
  plan.times.at = options.at;
  plan.times.from = options.from;
  plan.times.to = options.to;
  plan.times.interval = 1 / (plan.rate * options.slow_motion);
  return plan;
}

std::unique_ptr<Film> make_film(const RenderOptions& options, const RenderPlan& plan) {
  if (!options.frames.empty()) return png_film(options.frames);
  const FilmKind kind = options.mp4.empty() ? FilmKind::gif : FilmKind::mp4;
  make_folder(folder_of(plan.file), "--mp4");
  return ffmpeg_film(plan.file, {kind, plan.picture.width, plan.picture.height, plan.rate});
}

void print_render_json(const std::string& file, const RenderPlan& plan, const FilmedRun& run,
                       const std::vector<std::string>& notes) {
  fmt::print("{}\n", answer_text({{"file", file},
                                  {"width", plan.picture.width},
                                  {"height", plan.picture.height},
                                  {"pictures", run.shown.size()},
                                  {"from", run.shown.front().x.t},
                                  {"to", run.shown.back().x.t},
                                  {"warnings", notes}}));
}

int run_render(const RenderOptions& options) {
  const RenderPlan plan = read_render_options(options);
  Progress progress(options.json || !plan.times.is_film);
  progress.stage("run", 0.3);
  std::vector<FilmedRun> runs;
  if (options.side_by_side.empty())
    runs.push_back(film_run(options.robot, plan.times, options.camera, progress));
  else
    runs = film_pair(options.robot.model, options.side_by_side, plan.times);
  progress.stage("paint", 0.7);
  std::vector<FilmedRun*> shown;
  for (FilmedRun& run : runs) shown.push_back(&run);
  Rendering rendering(plan.picture, shown);
  const std::size_t count = runs.front().shown.size();
  const std::string file = plan.file.string();
  if (!plan.times.is_film) {
    write_png(file, rendering.paint(0));
  } else {
    const std::unique_ptr<Film> film = make_film(options, plan);
    for (std::size_t i = 0; i < count; ++i) {
      film->add(rendering.paint(i));
      progress.advance(i + 1, count);
    }
    film->finish();
  }
  progress.finish();
  for (const std::string& note : rendering.notes()) print_error("twinarm: {}\n", note);
  if (options.json)
    print_render_json(file, plan, runs.front(), rendering.notes());
  else
    fmt::print("wrote {}: {} picture{}, {} x {}\n", file, count, count == 1 ? "" : "s",
               plan.picture.width, plan.picture.height);
  return 0;
}

}  // namespace

Command render_command() {
  return {110, "render",
          "Render pictures and videos of a recording, a scene or a robot, without display or "
          "GPU\n\n"
          "Examples:\n"
          "  twinarm render assets/scenes/incline.toml --png incline.png --show forces,contacts\n"
          "  twinarm render out/run.twinrec --mp4 run.mp4 --slow-motion 4",
          add_options, run_render};
}

}  // namespace twinarm
