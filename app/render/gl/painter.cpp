// Draws each light sample, takes the mean, adds the lettering.
#include "app/render/gl/painter.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/render/gl/scene_pass.h"
#include "app/render/text/lettering.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

constexpr int kStudioSamples = 64;
constexpr double kKeyDiscRadius = 0.05;  // tangent of the key light's half angle

void check_camera(const Camera& camera) {
  const auto refuse = [](const std::string& problem, const std::string& fix) {
    throw InputError({Diagnostic{"", 0, "camera", problem, fix, "render.camera"}});
  };
  if (!camera.eye.allFinite() || !camera.target.allFinite() || !camera.up.allFinite())
    refuse("a coordinate is not a finite number", "give metres");
  if (!((camera.eye - camera.target).norm() > 0))
    refuse("eye and target coincide", "move its eye or its target");
  if (!(camera.field_of_view > 0 && camera.field_of_view < 3.1))
    refuse("its field of view is not between 0 and 3.1 rad", "0.55 is usual");
}

// Low-discrepancy numbers in [0, 1): Roberts' generalised golden ratio sequences.
double golden(int i, double ratio) {
  const double x = 0.5 + ratio * i;
  return x - std::floor(x);
}

Vector3 towards_key(const DrawList& list) {
  const Vector3 direction = list.light_W.normalized();
  return direction.allFinite() && direction.norm() > 0.5 ? direction : Vector3(0, 0, 1);
}

// Sample i: the key light is a disc, the sky a hemisphere, both sampled by Fibonacci spirals
// (uniform in height: the sky's mean irradiance on the floor equals that of the other qualities).
LightSample studio_sample(const Vector3& key_W, int i) {
  constexpr double kGoldenAngle = 2.39996322972865332;  // [rad]
  const Vector3 u = key_W.unitOrthogonal(), v = key_W.cross(u);
  const auto share = [](int k) { return (k + 0.5) / kStudioSamples; };

  LightSample sample;
  const double disc = kKeyDiscRadius * std::sqrt(share(i)), angle = kGoldenAngle * i;
  sample.key_W = (key_W + disc * (std::cos(angle) * u + std::sin(angle) * v)).normalized();
  // The sky in another order than the disc.
  const int k = (i * 37) % kStudioSamples;
  const double height = share(k), radius = std::sqrt(1 - height * height);
  const double azimuth = kGoldenAngle * k;
  sample.sky_W = {radius * std::cos(azimuth), radius * std::sin(azimuth), height};
  sample.shift_px = {golden(i, 0.8191725133961645) - 0.5, golden(i, 0.6710436067037893) - 0.5};
  return sample;
}

// Linear light of each sRGB byte (IEC 61966-2-1).
std::array<float, 256> linear_table() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double s = static_cast<double>(i) / 255;
    table[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  }
  return table;
}

float encode(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

// Mean of pictures in linear light, dithered.
class Mean {
 public:
  explicit Mean(std::size_t bytes) : sum_(bytes, 0.0f), linear_(linear_table()) {}
  void add(const std::vector<std::uint8_t>& rgba) {
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += linear_[rgba[i]];
    ++count_;
  }
  void write(std::vector<std::uint8_t>& rgba) const {
    for (std::size_t i = 0; i < sum_.size(); ++i) {
      const float value = 255 * encode(sum_[i] / static_cast<float>(count_));
      const double noise = golden(static_cast<int>((i / 4) % 65521), 0.6180339887498949);
      rgba[i] = static_cast<std::uint8_t>(std::min(255.0f, value + static_cast<float>(noise)));
    }
  }

 private:
  std::vector<float> sum_;
  std::array<float, 256> linear_;
  int count_ = 0;
};

// OpenGL's first row is the bottom one.
void flip_vertically(Image& image) {
  const std::size_t bytes = std::size_t{4} * static_cast<std::size_t>(image.width);
  std::vector<std::uint8_t> row(bytes);
  for (int y = 0; y < image.height / 2; ++y) {
    std::uint8_t *above = image.pixel(0, y), *below = image.pixel(0, image.height - 1 - y);
    std::memcpy(row.data(), above, bytes);
    std::memcpy(above, below, bytes);
    std::memcpy(below, row.data(), bytes);
  }
}

// Bound only while a picture is painted, so that the painter may change threads.
class CurrentContext {
 public:
  explicit CurrentContext(OffscreenContext& context) : context_(context) {
    context_.make_current();
  }
  ~CurrentContext() { context_.release(); }
  CurrentContext(const CurrentContext&) = delete;

 private:
  OffscreenContext& context_;
};

}  // namespace

class Painter::Impl {
 public:
  Impl(Backend backend, int width, int height, Quality quality)
      : context_(make_offscreen_context(backend)),
        width_(width),
        height_(height),
        quality_(quality) {
    const CurrentContext current(*context_);
    gl_.load([this](const char* name) { return context_->proc(name); });
    const bool is_normal = quality == Quality::normal;
    const ShaderVariant variant{is_normal, quality == Quality::studio};
    pass_ = std::make_unique<ScenePass>(gl_, width, height, variant, is_normal);
  }
  ~Impl() {
    const CurrentContext current(*context_);
    pass_.reset();
  }

  Image paint(const DrawList& list, bool is_next) {
    check_camera(list.camera);
    Image image = make_image(width_, height_);
    {
      const CurrentContext current(*context_);
      pass_->prepare(list);
      draw_samples(towards_key(list), image.rgba);
      if (const GLenum error = gl_.GetError())
        throw std::logic_error("OpenGL error " + std::to_string(error) + " in Painter::paint");
    }
    flip_vertically(image);
    draw_overlay(image, list, pass_->clip_from_world(), lettering_, is_next ? &labels_ : nullptr);
    return image;
  }

 private:
  void draw_samples(const Vector3& key_W, std::vector<std::uint8_t>& rgba) {
    if (quality_ != Quality::studio) {
      LightSample sample;
      sample.key_W = key_W;
      pass_->draw(sample);
      pass_->read(rgba.data());
      return;
    }
    Mean mean(rgba.size());
    for (int i = 0; i < kStudioSamples; ++i) {
      pass_->draw(studio_sample(key_W, i));
      pass_->read(rgba.data());
      mean.add(rgba);
    }
    mean.write(rgba);
  }

  std::unique_ptr<OffscreenContext> context_;
  GlTable gl_;
  int width_, height_;
  Quality quality_;
  std::unique_ptr<ScenePass> pass_;
  Lettering lettering_;
  LabelMemory labels_;
};

Painter::Painter(Backend backend, int width, int height, Quality quality)
    : impl_(std::make_unique<Impl>(backend, width, height, quality)) {}
Painter::~Painter() = default;

Image Painter::paint(const DrawList& list, bool is_next) {
  return impl_->paint(list, is_next);
}

}  // namespace twinarm
