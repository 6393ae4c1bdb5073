// Closed-form kinematics of the Omni: a two-link arm in a plane that rotates about the waist's
// axis. Device axes.
//
// In that plane (out from the waist's axis, up from the shoulder) the elbow is at L1 (cos theta2,
// sin theta2), and the forearm is L2 (sin t3, -cos t3), t3 = theta2 + theta3. Signs and lengths:
// published kinematics (docs/understand/phantom_omni.md). Angles of the triangle shoulder, elbow,
// point are computed by half-angle formulas, which are accurate for a stretched arm, where an arc
// cosine is not.
#include "coupling/device/omni.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace twinarm {
namespace {

constexpr double kSingular = 1e-6;  // minimum lever arm [m], minimum cos theta3

struct OmniArm {
  double s1, c1, s2, c2, s3, c3;  // of theta1, theta2, theta2 + theta3
  double R;                       // signed distance from the waist's axis [m]
  Vector3 side, out;              // x and z axes rotated by theta1
};

OmniArm omni_arm(const OmniParameters& omni, const OmniAngles& theta) {
  const double t3 = theta[1] + theta[2];
  OmniArm a{std::sin(theta[0]),
            std::cos(theta[0]),
            std::sin(theta[1]),
            std::cos(theta[1]),
            std::sin(t3),
            std::cos(t3),
            0,
            {},
            {}};
  a.R = omni.L1 * a.c2 + omni.L2 * a.s3;
  a.side = {a.c1, 0, a.s1};
  a.out = {-a.s1, 0, a.c1};
  return a;
}

// J^-1; rows of motors at a singularity are zero.
Matrix3 omni_jacobian_inverse(const OmniParameters& omni, const OmniAngles& theta) {
  const OmniArm a = omni_arm(omni, theta);
  Matrix3 inverse = Matrix3::Zero();
  if (std::abs(a.R) > kSingular) inverse.row(0) = -a.side.transpose() / a.R;
  // In the plane the columns are l1 + l2 and l2, with l1 = L1 (-s2, c2) and l2 = L2 (c3, s3).
  const double straight = -(a.c2 * a.c3 + a.s2 * a.s3);  // -cos theta3
  if (std::abs(straight) < kSingular) return inverse;
  const Vector3 up = Vector3::UnitY();
  const Vector3 to_2 = (a.s3 * a.out - a.c3 * up) / (omni.L1 * straight);
  const Vector3 to_3 = (a.c2 * a.out + a.s2 * up) / (omni.L2 * straight);
  inverse.row(1) = to_2;
  inverse.row(2) = -(to_2 + to_3);
  return inverse;
}

Matrix3 rotation_x(double angle) {
  return Eigen::AngleAxisd(angle, Vector3::UnitX()).toRotationMatrix();
}
Matrix3 rotation_y(double angle) {
  return Eigen::AngleAxisd(angle, Vector3::UnitY()).toRotationMatrix();
}
Matrix3 forearm_rotation(const std::array<double, 3>& theta) {
  return rotation_y(-theta[0]) * rotation_x(-(theta[1] + theta[2]));
}

// theta2, theta3 of a point in the arm's plane.
std::optional<std::array<double, 2>> reach_in_plane(const OmniParameters& omni, double out,
                                                    double up) {
  const double L1 = omni.L1, L2 = omni.L2, r = std::hypot(out, up);
  const double rounding = 1e-14 * (L1 + L2);
  double spare = L1 + L2 - r, over1 = r + L1 - L2, over2 = r + L2 - L1;
  if (!(spare >= -rounding && over1 >= -rounding && over2 >= -rounding)) return std::nullopt;
  spare = std::max(spare, 0.0);
  over1 = std::max(over1, 0.0);
  over2 = std::max(over2, 0.0);
  const double all = L1 + L2 + r;
  const double shoulder = 2 * std::atan2(std::sqrt(over2 * spare), std::sqrt(all * over1));
  const double elbow = 2 * std::atan2(std::sqrt(over1 * over2), std::sqrt(all * spare));
  return std::array<double, 2>{shoulder + std::atan2(up, out), elbow - std::numbers::pi / 2};
}

// Nearest angle in [low, high] on the circle.
double clamp_angle(double angle, double low, double high) {
  const double middle = 0.5 * (low + high);
  const double from = std::remainder(angle - middle, 2 * std::numbers::pi);
  return std::clamp(middle + from, low, high);
}

// theta2, theta3 of the nearest point within their ranges: the point itself, else on one of the
// four arcs that bound the workspace, each with one joint at a limit.
std::array<double, 2> nearest_in_plane(const OmniParameters& omni, double out, double up) {
  const double low2 = omni.lower[1], high2 = omni.upper[1];
  const double low3 = omni.lower[2], high3 = omni.upper[2];
  if (const auto q = reach_in_plane(omni, out, up))
    if ((*q)[0] >= low2 && (*q)[0] <= high2 && (*q)[1] >= low3 && (*q)[1] <= high3) return *q;

  std::array<double, 2> best{};
  double nearest = std::numeric_limits<double>::infinity();
  const auto try_angles = [&](double theta2, double theta3) {
    const double d_out = omni.L1 * std::cos(theta2) + omni.L2 * std::sin(theta2 + theta3) - out;
    const double d_up = omni.L1 * std::sin(theta2) - omni.L2 * std::cos(theta2 + theta3) - up;
    const double distance = std::hypot(d_out, d_up);
    if (!(distance < nearest)) return;
    nearest = distance;
    best = {theta2, theta3};
  };
  for (const double theta2 : {low2, high2}) {
    const double from_out = out - omni.L1 * std::cos(theta2);
    const double from_up = up - omni.L1 * std::sin(theta2);
    try_angles(theta2, clamp_angle(std::atan2(from_out, -from_up) - theta2, low3, high3));
  }
  for (const double theta3 : {low3, high3}) {
    const double at_zero =
        std::atan2(-omni.L2 * std::cos(theta3), omni.L1 + omni.L2 * std::sin(theta3));
    try_angles(clamp_angle(std::atan2(up, out) - at_zero, low2, high2), theta3);
  }
  return best;
}

}  // namespace

Vector3 omni_elbow(const OmniParameters& omni, const OmniAngles& theta) {
  const OmniArm a = omni_arm(omni, theta);
  return omni.L1 * (a.c2 * a.out + a.s2 * Vector3::UnitY()) + Vector3(0, omni.lift, -omni.back);
}

Vector3 omni_position(const OmniParameters& omni, const OmniAngles& theta) {
  const OmniArm a = omni_arm(omni, theta);
  return {-a.s1 * a.R, omni.L1 * a.s2 - omni.L2 * a.c3 + omni.lift, a.c1 * a.R - omni.back};
}

Matrix3 omni_jacobian(const OmniParameters& omni, const OmniAngles& theta) {
  const OmniArm a = omni_arm(omni, theta);
  const Vector3 up = Vector3::UnitY();
  const Vector3 by_arm = omni.L1 * (-a.s2 * a.out + a.c2 * up);
  const Vector3 by_forearm = omni.L2 * (a.c3 * a.out + a.s3 * up);
  Matrix3 J;
  // theta2 also rotates the forearm: theta3 is relative to the upper arm.
  J << -a.R * a.side, by_arm + by_forearm, by_forearm;
  return J;
}

Vector3 omni_force(const OmniParameters& omni, const OmniAngles& theta,
                   const std::array<double, 3>& torque) {
  const Vector3 tau(torque[0], torque[1], torque[2]);
  return omni_jacobian_inverse(omni, theta).transpose() * tau;
}

std::array<double, 3> omni_limit(const OmniParameters& omni, const OmniAngles& theta,
                                 const std::array<double, 3>& torque) {
  const double force = omni_force(omni, theta, torque).norm();
  if (!std::isfinite(force)) return {};
  const double part = force > omni.peak_force ? omni.peak_force / force : 1.0;
  return {part * torque[0], part * torque[1], part * torque[2]};
}

Pose omni_stylus(const OmniParameters& omni, const OmniAngles& theta) {
  const Matrix3 gimbal = rotation_y(-theta[3]) * rotation_x(theta[4] - omni.gimbal_pitch) *
                         Eigen::AngleAxisd(theta[5], Vector3::UnitZ());
  return {forearm_rotation({theta[0], theta[1], theta[2]}) * gimbal, omni_position(omni, theta)};
}

std::optional<std::array<double, 3>> omni_inverse(const OmniParameters& omni,
                                                  const Vector3& position) {
  const double x = position.x(), z = position.z() + omni.back;
  const auto q = reach_in_plane(omni, std::hypot(x, z), position.y() - omni.lift);
  if (!q) return std::nullopt;
  return std::array<double, 3>{-std::atan2(x, z), (*q)[0], (*q)[1]};
}

std::optional<OmniAngles> omni_inverse(const OmniParameters& omni, const Pose& stylus) {
  const auto arm = omni_inverse(omni, stylus.p);
  if (!arm) return std::nullopt;
  // Ry(a) Rx(b) Rz(c): its last column is (sin a cos b, -sin b, cos a cos b).
  const Matrix3 M = forearm_rotation(*arm).transpose() * stylus.R;
  const double cos_b = std::hypot(M(0, 2), M(2, 2));
  const double a = cos_b > 1e-12 ? std::atan2(M(0, 2), M(2, 2)) : 0.0;
  const double b = std::atan2(-M(1, 2), cos_b);
  const Matrix3 rest = rotation_y(-a) * M;  // Rx(b) Rz(c)
  const double c = std::atan2(-rest(0, 1), rest(0, 0));
  return OmniAngles{(*arm)[0], (*arm)[1], (*arm)[2], -a, b + omni.gimbal_pitch, c};
}

std::array<double, 3> omni_nearest(const OmniParameters& omni, const Vector3& position) {
  const double x = position.x(), z = position.z() + omni.back, up = position.y() - omni.lift;
  const double towards = -std::atan2(x, z);
  std::array<double, 3> best{};
  double nearest = std::numeric_limits<double>::infinity();
  // The arm's plane through the position, with either sign of R.
  for (const double waist : {towards, towards + std::numbers::pi}) {
    const double theta1 = clamp_angle(waist, omni.lower[0], omni.upper[0]);
    const double out = -std::sin(theta1) * x + std::cos(theta1) * z;
    const auto q = nearest_in_plane(omni, out, up);
    const OmniAngles theta{theta1, q[0], q[1]};
    const double distance = (omni_position(omni, theta) - position).norm();
    if (!(distance < nearest)) continue;
    nearest = distance;
    best = {theta1, q[0], q[1]};
  }
  return best;
}

}  // namespace twinarm
