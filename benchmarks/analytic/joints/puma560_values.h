// Reference values of the PUMA 560 (F1, assets/robots/puma560), g = 9.81 m/s^2 along -z of the
// base.
//
// Computed by an independent Newton-Euler code in more than double precision; all digits that the
// Robotics Toolbox publishes (5 or 6 of rne and accel) agree. rne(q, qd, qdd) is its inverse
// dynamics. Units: rad, rad/s^2, N m, kg m^2.
#pragma once

#include <array>

namespace twinarm::puma560 {

using Joints = std::array<double, 6>;

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr Joints kNominal{0, kPi / 4, kPi, 0, kPi / 4, 0};  // "qn"

// Gravity loads. That of joint 5 is m6 g 0.032 m for a horizontal flange axis (qn, qs), else zero.
struct GravityLoad {
  Joints q;
  Joints tau;
};
inline constexpr GravityLoad kGravityLoads[] = {
    {kNominal, {0, 31.639880378357127, 6.0351380230105125, 0, 0.028252800000000012, 0}},
    {{0, 0, 0, 0, 0, 0}, {0, 37.483666649999996, 0.24892875, 0, 0, 0}},                // "qz"
    {{0, kPi / 2, -kPi / 2, 0, 0, 0}, {0, -0.7752352499999957, 0.24892875, 0, 0, 0}},  // "qr"
    {{0, 0, -kPi / 2, 0, 0, 0},
     {0, 46.006938000000005, 8.772200100000003, 0, 0.0282528, 0}}};  // "qs"

inline constexpr Joints kArmature{0.784029968642,   2.324814845,         0.576873331938,
                                  0.19079062612368, 0.17070629165700002, 0.19406450566800004};

// Mass matrix at qn with armature: diagonal and three other entries.
inline constexpr Joints kMassDiagonal{3.65937541215279, 4.413741933635791,   0.9378415752150396,
                                      0.19253170612368, 0.17134845165700002, 0.19410450566800005};
inline constexpr double kM12 = -0.4043612460415188;
inline constexpr double kM13 = 0.10061364777978393;
inline constexpr double kM23 = 0.35089066495641474;

// Inverse dynamics at qn: from rest (armature, no friction) ...
inline constexpr Joints kTauFromRest{3.353110858063025,   36.002511243975704, 7.425964077350271,
                                     0.19004303456689686, 0.2034409311134147, 0.1941327899392475};
// ... at qd = qdd = 1 with armature and joint friction ...
inline constexpr Joints kTauMoving{32.49524275493071,  60.86698847513631,  17.74359491276432,
                                   1.4545190260797085, 1.2991104105378863, 0.7137808874836951};
// ... and of the links alone.
inline constexpr Joints kTauMovingLinks{1.1780065183379018,  35.460614988311306,
                                        6.097063990454122,   0.00047549025887667516,
                                        0.03511411794548652, 0.00021656854249492408};

// Forward dynamics at qn.
inline constexpr Joints kRate{0.1, 0.2, 0.8, 0.2, 0.5, 1.0};
inline constexpr Joints kTorque{1, 3.2, 1.8, 0.1, 0.7, 4.6};
inline constexpr Joints kAcceleration{-7.410223163685557, -9.843224581568439,  -10.969398445087409,
                                      -4.431428751376355, -0.9881410723986468, 21.02278194928692};
inline constexpr Joints kAccelerationNoFriction{-0.3540475686208445, -6.3989262832367535,
                                                -2.0684942474671573, 0.5112435385571794,
                                                4.021223156468258,   23.698454065202604};

}  // namespace twinarm::puma560
