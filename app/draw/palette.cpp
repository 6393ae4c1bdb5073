#include "app/draw/palette.h"

#include <algorithm>
#include <cmath>

namespace twinarm::palette {
namespace {

constexpr std::array<Color, kBodyColors> kHues{Color{0.34f, 0.56f, 0.74f, 1.0f},   // blue
                                               Color{0.90f, 0.70f, 0.36f, 1.0f},   // orange
                                               Color{0.30f, 0.60f, 0.50f, 1.0f},   // bluish green
                                               Color{0.78f, 0.48f, 0.36f, 1.0f},   // vermilion
                                               Color{0.66f, 0.80f, 0.88f, 1.0f},   // sky blue
                                               Color{0.70f, 0.54f, 0.66f, 1.0f},   // reddish purple
                                               Color{0.92f, 0.89f, 0.64f, 1.0f}};  // yellow

constexpr std::array<Color, 7> kLines{Color{0.00f, 0.45f, 0.70f, 1.0f},   // blue
                                      Color{0.84f, 0.37f, 0.00f, 1.0f},   // vermilion
                                      Color{0.00f, 0.62f, 0.45f, 1.0f},   // bluish green
                                      Color{0.10f, 0.12f, 0.15f, 1.0f},   // ink
                                      Color{0.80f, 0.47f, 0.65f, 1.0f},   // reddish purple
                                      Color{0.90f, 0.62f, 0.00f, 1.0f},   // orange
                                      Color{0.34f, 0.71f, 0.91f, 1.0f}};  // sky blue

// --c0 to --c6 of app/web/src/ui/style.css.
constexpr std::array<Color, 7> kLanes{Color{0.00f, 0.45f, 0.70f, 1.0f},   // blue
                                      Color{0.84f, 0.37f, 0.00f, 1.0f},   // vermilion
                                      Color{0.00f, 0.56f, 0.42f, 1.0f},   // bluish green
                                      Color{0.72f, 0.34f, 0.56f, 1.0f},   // reddish purple
                                      Color{0.79f, 0.54f, 0.00f, 1.0f},   // orange
                                      Color{0.23f, 0.61f, 0.85f, 1.0f},   // sky blue
                                      Color{0.48f, 0.42f, 0.00f, 1.0f}};  // olive

constexpr std::array<Color, 5> kRamp{
    Color{0.27f, 0.00f, 0.33f, 1.0f}, Color{0.23f, 0.32f, 0.55f, 1.0f},
    Color{0.13f, 0.57f, 0.55f, 1.0f}, Color{0.37f, 0.79f, 0.38f, 1.0f},
    Color{0.99f, 0.91f, 0.15f, 1.0f}};

float mix(float a, float b, float t) {
  return a + (b - a) * t;
}

}  // namespace

Color body(std::size_t i) {
  return kHues[i % kHues.size()];
}

Color lane(std::size_t i) {
  return kLanes[i % kLanes.size()];
}

Color curve(std::size_t i) {
  return kLines[i % kLines.size()];
}

Color ramp(double share) {
  const double at = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) * (kRamp.size() - 1) : 0;
  const auto i = std::min(static_cast<std::size_t>(at), kRamp.size() - 2);
  const auto t = static_cast<float>(at - static_cast<double>(i));
  const Color &a = kRamp[i], &b = kRamp[i + 1];
  return {mix(a.r, b.r, t), mix(a.g, b.g, t), mix(a.b, b.b, t), 1.0f};
}

}  // namespace twinarm::palette
