// `twinarm coupling predict`: linear analysis of a scene's couplings about one state at rest, with
// fixed targets.
//
// Rows of matrices are the robots' joint values (app/robot/coordinates.h) without mimic joints;
// free bodies are left out.
#pragma once

#include <Eigen/Core>
#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "app/run/simulate_input.h"
#include "coupling/analysis/gains.h"
#include "coupling/analysis/prediction.h"
#include "coupling/laws/coupling_spec.h"

namespace twinarm {

// Motion of the targets, and a wall.
struct PredictTask {
  double distance = 0, time = 1;  // of the target along a mode, or in each joint [rad or m], [s]
  std::optional<double> wall;     // stiffness [N/m]
  // Share of the distance by row, for errors of joints; empty: 1 for all.
  std::vector<std::pair<std::string, double>> along;
  // Distance of prismatic joints: a millimetre per degree [m].
  double slide() const { return 180 / std::numbers::pi * distance / 1000; }
};

// Lever arm of a point spring about a joint between base and point.
struct SpringArm {
  std::string joint;
  double radius = 0, target_radius = 0;  // of the link's point and of its target [m]
  double max_target_radius = 0;          // stability limit at the step of the scene [m]
  double max_torque = 0;                 // k r R_K, at a right angle [N m]
};

struct PredictedCoupling : CouplingTraits {
  std::string kind;
  bool is_length = true;            // its error is a length: between points, or a prismatic joint
  SpringGains gains;                // N/m, N s/m of lengths; else N m/rad, N m s/rad
  double offset = 0;                // of the target [m or rad]
  Eigen::MatrixXd K, K_zero, B;     // stiffness; the same without geometric part; damping
  double added_inertia = 0;         // added by the law [kg or kg m^2]
  Eigen::MatrixXd M_added;          // inertia that the law adds (coupling/laws/mujoco_weld.h)
  Eigen::MatrixXd landing;          // of a god object: rows of M of its robot; else empty
  SpringResponse alone;             // highest mode with this coupling alone
  std::vector<SpringArm> arms;      // linear only
  std::optional<double> with_wall;  // in series with the wall [N/m]
  // No Discretization applies to it.
  bool is_own_discretization() const {
    return facts_of(law, printed).discretizations == CouplingFacts::Discretizations::own;
  }
};

inline constexpr std::array<MotionProfile, 4> kSmoothMoves{
    MotionProfile::cubic, MotionProfile::quintic, MotionProfile::cosine, MotionProfile::bang_bang};

// Peak tracking errors for a target that moves `distance` in `time` along a mode [rad or m].
struct ModeErrors {
  double start = 0, reversal = 0;  // velocity step to, and reversal of, distance/time
  std::array<double, 4> smooth{};  // cubic, quintic, cosine, bang-bang
  double absolute_lag = 0;         // of an absolute damper, at distance/time
  double weld_lag = 0;             // of a mocap weld with this frequency
};

// Peak tracking error of each joint, by rows, when all targets move at once [rad or m]. NaN where
// the joint has no coupling or the error is unbounded.
struct RowErrors {
  Eigen::VectorXd distance, start, reversal;
  std::array<Eigen::VectorXd, 4> smooth;
  Eigen::VectorXd lag;  // steady state at distance/time: absolute dampers, joint damping, delays
};

struct PredictedMode {
  double omega = 0, zeta = 0;
  Eigen::VectorXd shape;  // by rows, its largest part 1
  ModeErrors errors;
};

struct SchemeLimit {
  SteppingScheme scheme;
  double max_step = 0;               // [s]
  double by_ratio = 0, by_zeta = 0;  // factors of the stiffness at the scene's step
  bool selected = false;
};

struct Predicted {
  std::vector<std::string> rows;
  std::vector<bool> is_angle;  // of rows; else a length
  std::vector<PredictedCoupling> couplings;
  Eigen::MatrixXd M, K, B;  // of all couplings
  std::vector<PredictedMode> modes;
  std::vector<SchemeLimit> limits;
  Integrator integrator = Integrator::semi_implicit;
  std::string stepped;              // integrator and discretizations of the scene
  double step = 0;                  // [s]
  double max_step = 0;              // largest stable step of the scene
  double growth = 1;                // spectral radius of a step; not for dopri5
  Eigen::VectorXd sag;              // static deflection by rows; NaN without coupling
  std::optional<RowErrors> errors;  // not of robots with very many joints
  std::vector<std::string> warnings;
};

// Throws InputError if no coupling can be analysed.
Predicted predict_couplings(SimulatePlan& prepared, const PredictTask& task);

std::string predicted_table(const Predicted& found, const PredictTask& task);
std::string predicted_json(const Predicted& found, const PredictTask& task);

// `twinarm coupling gains`: one spring-damper in the parameters of other couplings and engines.

struct Equivalents {
  std::string name, kind;  // of a scene's coupling; empty of gains from the command line
  bool is_length = true;   // N/m, N s/m and kg; else N m/rad, N m s/rad and kg m^2
  bool is_weld = false;    // the gains are those of a spring with its frequency and damping ratio
  double inertia = 0;      // smallest apparent inertia [kg or kg m^2]
  SpringGains gains;
  SpringResponse response;
  std::optional<SpringGains> wanted;        // for the requested frequency and damping ratio
  std::optional<SpringGains> as_torsional;  // of a point spring, about the joint of its link
  double radius = 0;                        // about that joint [m]
  std::optional<Solref> solref, direct;  // (timeconst, dampratio) only where k and b are positive
  double static_stiffness = 0;           // of MuJoCo's constraint under a constant load
  Drive force_drive, acceleration_drive;
};

Equivalents equivalents_of(const SpringGains& gains, double inertia,
                           const MujocoImpedance& impedance);

// Of each coupling with a stiffness, at the state of the scene.
std::vector<Equivalents> scene_equivalents(SimulateInput& input,
                                           const std::optional<SpringResponse>& wanted,
                                           const MujocoImpedance& impedance);

std::string equivalents_table(const std::vector<Equivalents>& all, double step);
std::string equivalents_json(const std::vector<Equivalents>& all);

}  // namespace twinarm
