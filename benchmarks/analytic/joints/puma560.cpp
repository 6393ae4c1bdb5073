// F1: the PUMA 560 from its Denavit-Hartenberg parameters (Armstrong, Khatib, Burdick 1986; Corke,
// Armstrong-Helouvry 1994): A_i = Rz(q_i) Tz(d_i) Tx(a_i) Rx(alpha_i). Gravity loads, mass matrix,
// inverse and forward dynamics against an independent code, and against the digits that the
// Robotics Toolbox publishes.
#include <algorithm>
#include <limits>

#include "benchmarks/analytic/joints/puma560_values.h"
#include "benchmarks/analytic/support/smooth_parts.h"
#include "solver/dynamics/dynamics.h"

namespace twinarm {
namespace {

using puma560::Joints;

struct PumaLink {
  double a, d;                // [m]
  int alpha;                  // [90 degrees]
  double mass;                // [kg]
  std::array<double, 3> com;  // in frame i [m]
  std::array<double, 3> I;    // about it, axes of frame i [kg m^2]
};
constexpr std::array<PumaLink, 6> kPumaLinks{{
    {0, 0, 1, 0, {0, 0, 0}, {0, 0.35, 0}},
    {0.4318, 0, 0, 17.4, {-0.3638, 0.006, 0.2275}, {0.13, 0.524, 0.539}},
    {0.0203, 0.15005, -1, 4.8, {-0.0203, -0.0141, 0.070}, {0.066, 0.086, 0.0125}},
    {0, 0.4318, 1, 0.82, {0, 0.019, 0}, {1.8e-3, 1.3e-3, 1.8e-3}},
    {0, 0, -1, 0.34, {0, 0, 0}, {0.3e-3, 0.4e-3, 0.3e-3}},
    {0, 0, 0, 0.09, {0, 0, 0.032}, {0.15e-3, 0.15e-3, 0.04e-3}},
}};
struct PumaMotor {
  double inertia, gear;  // of the motor [kg m^2]; gear ratio without sign
  double viscous;        // friction of the motor [N m s/rad]
  double plus, minus;    // its Coulomb friction, by the sign of the joint velocity [N m]
};
constexpr std::array<PumaMotor, 6> kPumaMotors{{
    {200e-6, 62.6111, 1.48e-3, 0.395, 0.435},
    {200e-6, 107.815, 0.817e-3, 0.126, 0.071},
    {200e-6, 53.7063, 1.38e-3, 0.132, 0.105},
    {33e-6, 76.0364, 71.2e-6, 11.2e-3, 16.9e-3},
    {33e-6, 71.923, 82.6e-6, 9.26e-3, 14.5e-3},
    {33e-6, 76.686, 36.7e-6, 3.96e-3, 10.5e-3},
}};

// Link i is frame i-1 rotated by q_i; the constant rest of A_i is the pose of frame i, to which the
// inertia and the next joint refer.
Model<double> puma() {
  ModelBuilder builder;
  int parent = 0;
  Pose joint{};
  for (std::size_t i = 0; i < 6; ++i) {
    const PumaLink& row = kPumaLinks[i];
    const PumaMotor& motor = kPumaMotors[i];
    const double s = row.alpha, c = row.alpha == 0 ? 1 : 0, G = motor.gear;
    Pose rest{Matrix3::Identity(), {row.a, 0, row.d}};
    rest.R << 1, 0, 0, 0, c, -s, 0, s, c;
    const Matrix3 moments = Vector3(row.I.data()).asDiagonal();
    const BodyInertia inertia{row.mass, rest * Vector3(row.com.data()),
                              rest.R * moments * rest.R.transpose()};
    const JointProperties properties{.armature = G * G * motor.inertia,
                                     .damping = G * G * motor.viscous,
                                     .coulomb_plus = G * motor.plus,
                                     .coulomb_minus = G * motor.minus};
    const std::string n = std::to_string(parent + 1);
    parent = builder.add_body("link" + n, parent, "j" + n, JointType::revolute, joint,
                              Vector3::UnitZ(), inertia, properties);
    joint = rest;
  }
  return builder.build();
}

State<double> puma_state(const Model<double>& model, const Joints& q, const Joints& qd = {}) {
  State<double> x(model);
  x.q.assign(q.begin(), q.end());
  x.qd.assign(qd.begin(), qd.end());
  return x;
}
CaseReadings joined(const std::vector<CaseReadings>& parts) {
  CaseReadings all;
  for (const CaseReadings& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}
CaseReadings values_of(const Joints& values) {
  return {values.begin(), values.end()};
}

// rne(q, qd, qdd) of the toolbox, with motors and joint friction.
std::vector<double> puma_torques(const Model<double>& model, const Joints& q, const Joints& qd,
                                 double qdd) {
  std::vector<double> tau =
      inverse_dynamics(model, puma_state(model, q, qd), std::vector<double>(6, qdd));
  for (std::size_t k = 0; k < 6; ++k)
    tau[k] += model.damping[k] * qd[k] + (qd[k] > 0   ? model.coulomb_plus[k]
                                          : qd[k] < 0 ? -model.coulomb_minus[k]
                                                      : 0);
  return tau;
}
Model<double> without_friction(Model<double> model) {
  for (auto* law : {&model.damping, &model.coulomb_plus, &model.coulomb_minus})
    std::fill(law->begin(), law->end(), 0);
  return model;
}
Model<double> links_alone(const Model<double>& model) {
  Model<double> bare = without_friction(model);
  std::fill(bare.armature.begin(), bare.armature.end(), 0);
  return bare;
}
// With the solver's joint friction.
std::vector<double> puma_accelerations(const Model<double>& model) {
  return evaluate(model, puma_state(model, puma560::kNominal, puma560::kRate),
                  values_of(puma560::kTorque))
      .qdd;
}

// Maximum over groups of six readings of relative_to_largest().
double relative_by_six(const CaseReadings& seen, const CaseReadings& exact) {
  if (seen.size() != exact.size() || seen.size() % 6 != 0)
    return std::numeric_limits<double>::quiet_NaN();
  double error = 0;
  for (std::size_t i = 0; i < seen.size(); i += 6) {
    const auto six = [i](const CaseReadings& all) {
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(i);
      return CaseReadings(first, first + 6);
    };
    error = nan_max(error, relative_to_largest(six(seen), six(exact)));
  }
  return error;
}
std::vector<std::string> puma_names(const std::vector<std::string>& rows, const char* unit) {
  std::vector<std::string> names;
  for (const std::string& row : rows)
    for (int k = 1; k <= 6; ++k) names.push_back(row + " " + std::to_string(k) + " [" + unit + "]");
  return names;
}

using PumaReadings = CaseReadings (*)(const Model<double>& model);
TrajectoryCase puma_case(std::vector<std::string> readings, PumaReadings seen, CaseReadings exact,
                         CaseMeasure measure = relative_by_six) {
  const CaseObserver observe = [seen](ModelRef model, StateRef) { return seen(model); };
  return evaluation(at_rest(puma()), std::move(readings), observe, std::move(exact), measure);
}

TrajectoryCase puma_weight() {
  CaseReadings exact;
  for (const puma560::GravityLoad& load : puma560::kGravityLoads)
    exact = joined({exact, values_of(load.tau)});
  return puma_case(
      puma_names({"qn", "qz", "qr", "qs"}, "N m"),
      [](const Model<double>& model) {
        CaseReadings all;
        for (const puma560::GravityLoad& load : puma560::kGravityLoads)
          all = joined({all, puma_torques(model, load.q, {}, 0)});
        return all;
      },
      exact);
}

TrajectoryCase puma_mass() {
  std::vector<std::string> readings = puma_names({"armature", "M diagonal"}, "kg m^2");
  for (const char* entry : {"M12", "M13", "M23"})
    readings.push_back(std::string(entry) + " [kg m^2]");
  TrajectoryCase c = puma_case(
      readings,
      [](const Model<double>& model) {
        CaseReadings all = model.armature;
        const Eigen::MatrixXd M = mass_matrix(model, puma_state(model, puma560::kNominal));
        for (Eigen::Index k = 0; k < 6; ++k) all.push_back(M(k, k));
        return joined({all, {M(0, 1), M(0, 2), M(1, 2)}});
      },
      joined({values_of(puma560::kArmature),
              values_of(puma560::kMassDiagonal),
              {puma560::kM12, puma560::kM13, puma560::kM23}}),
      relative_to_largest);
  c.mutant = more_inertia;
  return c;
}

constexpr Joints kOnes{1, 1, 1, 1, 1, 1};

TrajectoryCase puma_inverse() {
  return puma_case(
      puma_names({"from rest", "moving", "links alone"}, "N m"),
      [](const Model<double>& model) {
        const Joints& qn = puma560::kNominal;
        return joined({puma_torques(model, qn, {}, 1), puma_torques(model, qn, kOnes, 1),
                       puma_torques(links_alone(model), qn, kOnes, 1)});
      },
      joined({values_of(puma560::kTauFromRest), values_of(puma560::kTauMoving),
              values_of(puma560::kTauMovingLinks)}));
}

TrajectoryCase puma_forward() {
  return puma_case(
      puma_names({"with friction", "without"}, "rad/s^2"),
      [](const Model<double>& model) {
        return joined({puma_accelerations(model), puma_accelerations(without_friction(model))});
      },
      joined({values_of(puma560::kAcceleration), values_of(puma560::kAccelerationNoFriction)}));
}

// Published rne from rest, rne moving, accel; and the unit of the last digit of each.
constexpr std::array<double, 18> kPublished{
    3.35311, 36.0025, 7.42596,  0.190043, 0.203441, 0.194133, 32.4952, 60.867,  17.7436,
    1.45452, 1.29911, 0.713781, -7.4102,  -9.8432,  -10.9694, -4.4314, -0.9881, 21.0228};
constexpr std::array<double, 18> kLastDigit{1e-5, 1e-4, 1e-5, 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4,
                                            1e-5, 1e-5, 1e-6, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4};
CaseReadings in_last_digits(CaseReadings all) {
  for (std::size_t i = 0; i < all.size(); ++i) all[i] /= kLastDigit[i];
  return all;
}
TrajectoryCase puma_published() {
  return puma_case(
      puma_names({"from rest", "moving", "acceleration"}, "last digits"),
      [](const Model<double>& model) {
        const Joints& qn = puma560::kNominal;
        return in_last_digits(
            joined({puma_torques(model, qn, {}, 1), puma_torques(model, qn, kOnes, 1),
                    puma_accelerations(model)}));
      },
      in_last_digits({kPublished.begin(), kPublished.end()}), max_difference);
}

}  // namespace

CaseFamily puma560_cases() {
  return {320,
          {{"F1", 1e-12, puma_weight()},
           {"F1-mass", 1e-12, puma_mass()},
           {"F1-inverse", 1e-12, puma_inverse()},
           {"F1-forward", 1e-12, puma_forward()},
           {"F1-published", 0.5, puma_published()}}};
}

}  // namespace twinarm
