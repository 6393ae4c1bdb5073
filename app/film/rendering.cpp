#include "app/film/rendering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/draw/overlays/overlays.h"
#include "app/render/text/plot.h"

namespace twinarm {
namespace {

constexpr int kGap = 4;              // between two views [px]
constexpr double kPlotShare = 0.24;  // of the picture's height

void copy_into(Image& image, const Image& part, int left, int top) {
  for (int y = 0; y < part.height; ++y)
    std::copy_n(part.pixel(0, y), 4 * part.width, image.pixel(left, top + y));
}

bool same_legend(const std::vector<LegendLine>& a, const std::vector<LegendLine>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const LegendLine& x, const LegendLine& y) { return x.words() == y.words(); });
}

}  // namespace

// One run in its part of the picture.
class Rendering::View {
 public:
  View(const PictureWish& wish, const FilmedRun& run, int left, int width)
      : run_(run),
        stage_(run.plan.input.scene ? make_stage(*run.plan.input.scene)
                                    : make_stage(run.plan.input.robot.robot, run.model())),
        camera_wish_(parse_camera(wish.camera, run.model())),
        left_(left),
        width_(width),
        plot_height_(wish.curves.empty() ? 0
                                         : static_cast<int>(std::lround(kPlotShare * wish.height))),
        height_(wish.height - plot_height_) {
    if (!run.name.empty()) stage_.name = run.name;
    stage_.frames_device = std::ranges::find(wish.overlays, "device") != wish.overlays.end();
    stage_.list.background = wish.background;
    for (const RunInstant& instant : run.around) look_ahead(stage_, run.moment(instant));
    for (const RunInstant& instant : run.shown) look_at(stage_, run.moment(instant));
    settle(stage_);
    for (const RunInstant& instant : run.around)
      measure(stage_, run.moment(instant), Measured::of_run);
    for (const RunInstant& instant : run.shown)
      measure(stage_, run.moment(instant), Measured::of_picture);
    plot(wish);
    painter_.emplace(wish.backend, width_, height_, wish.quality);
  }

  // Both show what either has.
  void share(View& other) {
    stage_.extent.add(other.stage_.extent);
    other.stage_.extent = stage_.extent;
    stage_.scales.widen(other.stage_.scales);
    other.stage_.scales = stage_.scales;
    for (std::size_t p = 0; p < plots_.size(); ++p)
      plots_[p].range = other.plots_[p].range = range_of({&plots_[p], &other.plots_[p]});
  }
  void set() {
    if (camera_wish_.follow > 0 && !(camera_wish_.distance > 0))
      camera_wish_.distance = closeup(stage_.cast, camera_wish_.follow);
    set_view(stage_, camera_wish_, static_cast<double>(width_) / height_);
    camera_ = stage_.list.camera;
    if (!plots_.empty()) strip_.emplace(plots_, width_, plot_height_);
  }

  // With the legend of the view before, if it says the same, left out.
  void paint(std::size_t picture, const std::vector<std::string>& overlays,
             const std::vector<LegendLine>* before, Image& image) {
    const RunInstant& instant = run_.shown[picture];
    const Snapshot moment = run_.moment(instant);
    draw(stage_, moment, overlays);
    DrawList& list = stage_.list;
    legend_ = list.legend;
    if (before && same_legend(*before, legend_)) list.legend.clear();
    list.camera = camera_;
    if (camera_wish_.follow > 0)
      list.camera = follow(
          camera_, com_of(run_.model(), moment.k, static_cast<std::size_t>(camera_wish_.follow)));
    const bool is_static = run_.shown.size() == 1 && instant.x.t == 0;
    list.title =
        is_static ? stage_.name : fmt::format("{}, t = {:.3f} s", stage_.name, instant.x.t);
    const bool is_film = run_.shown.size() > 1;
    copy_into(image, is_film ? painter_->paint_next(list) : painter_->paint(list), left_, 0);
    if (strip_) copy_into(image, strip_->at(instant.x.t), left_, height_);
  }
  const std::vector<LegendLine>& legend() const { return legend_; }
  const std::vector<std::string>& notes() const { return stage_.cast.notes; }

 private:
  void plot(const PictureWish& wish) {
    CurveTrace trace(wish.curves);
    for (const RunInstant& instant : run_.around)
      trace.add(run_.plan.input.scene.get(), run_.moment(instant));
    plots_ = trace.plots();
  }

  const FilmedRun& run_;
  SceneView stage_;
  CameraWish camera_wish_;
  int left_, width_, plot_height_, height_;
  Camera camera_;
  std::vector<Plot> plots_;
  std::vector<LegendLine> legend_;
  std::optional<PlotStrip> strip_;
  std::optional<Painter> painter_;
};

Rendering::Rendering(const PictureWish& wish, const std::vector<const FilmedRun*>& runs)
    : wish_(wish) {
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
