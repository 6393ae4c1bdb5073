// Colours: muted for bodies, saturated for forces. sRGB in 0..1.
//
// Hues of Okabe and Ito (Color Universal Design, 2008), safe for colour-blind viewers.
#pragma once

#include <array>
#include <cstddef>

#include "app/render/list/draw_list.h"

namespace twinarm::palette {

Color body(std::size_t i);  // of free bodies, cyclic
inline constexpr std::size_t kBodyColors = 7;
Color lane(std::size_t i);   // of variants, as their curves on a light page
Color curve(std::size_t i);  // saturated, for lines

inline const Color kObstacle{0.60f, 0.58f, 0.55f, 1.0f};
inline const Color kDriven{0.50f, 0.52f, 0.58f, 1.0f};  // prescribed motion
inline const Color kTargetRobot{0.25f, 0.50f, 0.95f, 0.30f};
inline const Color kTargetRobotSwatch{0.45f, 0.62f, 0.95f, 1.0f};
inline const Color kBefore{0.85f, 0.45f, 0.05f, 0.30f};  // previous branch
inline const Color kBeforeSwatch{0.90f, 0.64f, 0.38f, 1.0f};
inline constexpr float kHollow = 0.28f;  // opacity of cavities

inline const Color kForce{0.80f, 0.16f, 0.14f, 1.0f};
inline const Color kPoint{0.12f, 0.12f, 0.14f, 1.0f};
inline const Color kNormal{0.00f, 0.45f, 0.70f, 1.0f};
inline const Color kCone{0.95f, 0.75f, 0.25f, 0.30f};
inline const Color kConeSwatch{0.93f, 0.77f, 0.40f, 1.0f};
inline const Color kGravity{0.35f, 0.35f, 0.38f, 1.0f};
inline const Color kConstraint{0.34f, 0.36f, 0.40f, 1.0f};
inline const Color kLinear{0.00f, 0.62f, 0.45f, 1.0f};   // momentum
inline const Color kAngular{0.80f, 0.47f, 0.65f, 1.0f};  // angular momentum
inline const Color kInertia{0.90f, 0.60f, 0.10f, 0.30f};
inline const Color kInertiaSwatch{0.92f, 0.70f, 0.36f, 1.0f};
inline const Color kArticulated{0.00f, 0.55f, 0.50f, 0.38f};
inline const Color kArticulatedSwatch{0.36f, 0.68f, 0.64f, 1.0f};
inline const Color kDeviceForce{0.00f, 0.45f, 0.70f, 1.0f};       // force feedback
inline const Color kDeviceForceLimit{0.84f, 0.37f, 0.00f, 1.0f};  // at the device's limit
inline const Color kDeviceForceRest{0.50f, 0.55f, 0.60f, 0.35f};
inline const Color kMouse{0.80f, 0.20f, 0.55f, 1.0f};

// Axes x, y, z: red, green, blue of different lightness.
inline const std::array<Color, 3> kAxes{Color{0.80f, 0.22f, 0.16f, 1.0f},
                                        Color{0.25f, 0.62f, 0.25f, 1.0f},
                                        Color{0.13f, 0.28f, 0.75f, 1.0f}};

// Dark violet (0), green, yellow (1), of increasing lightness (after viridis, S. van der Walt and
// N. Smith).
Color ramp(double share);

}  // namespace twinarm::palette
