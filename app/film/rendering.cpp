#include "app/film/rendering.h"

#include "app/draw/overlays/overlays.h"
#include "app/inspect/report/inspect_output.h"

namespace twinarm {
namespace {

constexpr int kGap = 4;              // between two views [px]
constexpr double kPlotShare = 0.24;  // of the picture's height

void copy_into(Image& image, const Image& part, int left, int top) {
  for (int y = 0; y < part.height; ++y)
    std::copy_n(part.pixel(0, y), 4 * part.width, image.pixel(left, top + y));
}

// With the forces of the semi-implicit step that begins at the instant.
Inspection inspect(FilmedRun& run, const RunInstant& instant) {
  SimulateInput& input = run.plan.input;
  set_pose(input.robot, instant.x);
  StateArchive memory = simulation_memory(
      run.recording ? memory_at(*run.recording, run.recording->at(instant.x.t, "--at"), *run.files)
                    : instant.memory);
  Inspected found =
      input.scene
          ? SceneInspector(input, run.plan.run.step, {}, run.plan.run.integrator).look(&memory)
          : inspect_robot(input.robot);
  return {run.model(), std::move(found.x), std::move(found.actors), std::move(found.loops)};
}

}  // namespace

// One run in its part of the picture.
class Rendering::View {
 public:
  View(const PictureWish& wish, FilmedRun& run, int left, int width)
      : run_(run),
        view_(view_of(run)),
        camera_wish_(parse_camera(wish.camera, run.model())),
        orbit_(wish.orbit),
        left_(left),
        width_(width),
        plot_height_(wish.curves.empty() ? 0
                                         : static_cast<int>(std::lround(kPlotShare * wish.height))),
        height_(wish.height - plot_height_) {
    if (!run.name.empty()) view_.name = run.name;
    camera_wish_.field_of_view = wish.field_of_view;
    view_.frames_device = std::ranges::find(wish.overlays, "device") != wish.overlays.end();
    view_.list.background = wish.background;
    CurveTrace trace(wish.curves);
    for (const RunInstant& instant : run.around)
      trace.add(run.plan.input.scene.get(), run.snapshot(instant));
    plots_ = trace.plots();
    painter_.emplace(wish.backend, width_, height_, wish.quality);
  }

  // Both get the union of extents, scales and ranges.
  void share(View& other) {
    view_.extent.add(other.view_.extent);
    other.view_.extent = view_.extent;
    view_.scales.widen(other.view_.scales);
    other.view_.scales = view_.scales;
    for (std::size_t p = 0; p < plots_.size(); ++p)
      plots_[p].range = other.plots_[p].range = range_of({&plots_[p], &other.plots_[p]});
  }
  void set() {
    if (camera_wish_.follow > 0 && !(camera_wish_.distance > 0))
      camera_wish_.distance = closeup(view_.cast, camera_wish_.follow, camera_wish_.field_of_view);
    else if (orbit_ != 0 && !(camera_wish_.distance > 0))  // the bounding sphere fits
      camera_wish_.distance =
          kFrameMargin * view_.extent.radius() / std::sin(0.5 * camera_wish_.field_of_view);
    set_view(view_, camera_wish_, static_cast<double>(width_) / height_);
    camera_ = view_.list.camera;
    if (!plots_.empty()) strip_.emplace(plots_, width_, plot_height_);
  }

  // Without legend if it equals that of the view before.
  void paint(std::size_t picture, const std::vector<std::string>& overlays,
             const std::vector<LegendLine>* before, Image& image) {
    const RunInstant& instant = run_.shown[picture];
    const Snapshot snapshot = run_.snapshot(instant);
    draw(view_, snapshot, overlays);
    if (std::ranges::find(overlays, "wrenches") != overlays.end())
      add_wrenches(view_, inspect(run_, instant));
    DrawList& list = view_.list;
    legend_ = list.legend;
    if (before && std::ranges::equal(*before, legend_, {}, &LegendLine::words, &LegendLine::words))
      list.legend.clear();
    list.camera = camera_;
    if (orbit_ != 0) {
      const Eigen::AngleAxisd turn(orbit_ * static_cast<double>(picture), Vector3::UnitZ());
      list.camera.eye = camera_.target + turn * (camera_.eye - camera_.target);
      list.camera.up = turn * camera_.up;
    }
    if (camera_wish_.follow > 0)
      list.camera = follow(list.camera, com_of(run_.model(), snapshot.k,
                                               static_cast<std::size_t>(camera_wish_.follow)));
    const bool is_static = run_.shown.size() == 1 && instant.x.t == 0;
    list.title = is_static ? view_.name : fmt::format("{}, t = {:.3f} s", view_.name, instant.x.t);
    const bool is_film = run_.shown.size() > 1;
    copy_into(image, painter_->paint(list, is_film), left_, 0);
    if (strip_) copy_into(image, strip_->at(instant.x.t), left_, height_);
  }
  const std::vector<LegendLine>& legend() const { return legend_; }
  const std::vector<std::string>& notes() const { return view_.cast.notes; }

 private:
  FilmedRun& run_;
  SceneView view_;
  CameraWish camera_wish_;
  double orbit_;  // per picture [rad]
  int left_, width_, plot_height_, height_;
  Camera camera_;
  std::vector<Plot> plots_;
  std::vector<LegendLine> legend_;
  std::optional<PlotStrip> strip_;
  std::optional<Painter> painter_;
};

Rendering::Rendering(const PictureWish& wish, const std::vector<FilmedRun*>& runs) : wish_(wish) {
  const int half = (wish.width - kGap) / 2;
  if (runs.size() == 1) {
    views_.push_back(std::make_unique<View>(wish, *runs[0], 0, wish.width));
  } else {
    views_.push_back(std::make_unique<View>(wish, *runs[0], 0, half));
    views_.push_back(std::make_unique<View>(wish, *runs[1], wish.width - half, half));
    views_[0]->share(*views_[1]);
  }
  for (const auto& view : views_) view->set();
}

Rendering::~Rendering() = default;

Image Rendering::paint(std::size_t picture) {
  Image image = make_image(wish_.width, wish_.height, 255);
  const std::vector<LegendLine>* before = nullptr;
  for (const auto& view : views_) {
    view->paint(picture, wish_.overlays, before, image);
    before = &view->legend();
  }
  return image;
}

std::vector<std::string> Rendering::notes() const {
  std::vector<std::string> all;
  for (const auto& view : views_)
    for (const std::string& note : view->notes())
      if (std::ranges::find(all, note) == all.end()) all.push_back(note);
  return all;
}

}  // namespace twinarm
