// What `twinarm coupling predict` says of the couplings of a scene in one state.
//
// All matrices by the rows of the robots' joint values (app/robot/coordinates.h), followers
// eliminated; free bodies are left out. About the state at rest, the kinematic side held still.
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

// What the follower is asked to do, and the wall that it meets.
struct PredictTask {
  double distance = 0, time = 1;  // of the target along a mode, or in each joint [rad or m], [s]
  std::optional<double> wall;     // stiffness [N/m]
  // Of the joints' errors: what part of the distance each row goes; none: all go all of it.
  std::vector<std::pair<std::string, double>> along;
  // A slide goes a millimetre for a degree [m].
  double slide() const { return 180 / std::numbers::pi * distance / 1000; }
};

// The arm of a point spring about a joint below it.
struct SpringArm {
  std::string joint;
  double radius = 0, target_radius = 0;  // of the link's point and of its target [m]
  double max_target_radius = 0;          // with the step of the scene [m]
  double max_torque = 0;                 // k r R_K, at a right angle [N m]
};

struct PredictedCoupling : CouplingTraits {
  std::string kind;
  bool is_linear = true;            // between points
  bool is_length = true;            // it measures metres: between points, or along a slide
  SpringGains gains;                // N/m, N s/m of lengths; else N m/rad, N m s/rad
  double offset = 0;                // of the target [m or rad]
  Eigen::MatrixXd K, K_zero, B;     // as it is; without the geometric part; damping
  double felt_mass = 0;             // [kg or kg m^2]
  Eigen::MatrixXd felt;             // inertia that the law adds (coupling/laws/mujoco_weld.h)
  Eigen::MatrixXd landing;          // of a god object: rows of M of its robot; else empty
  SpringResponse alone;             // its fastest mode, were there no other
  std::vector<SpringArm> arms;      // linear only
  std::optional<double> with_wall;  // the wall through this coupling [N/m]
  // It has none of the three treatments.
  bool is_own_treatment() const {
    return facts_of(law, printed).treatments == CouplingFacts::Discretizations::own;
  }
};

inline constexpr std::array<MotionProfile, 4> kSmoothMoves{
    MotionProfile::cubic, MotionProfile::quintic, MotionProfile::cosine, MotionProfile::bang_bang};

// The errors behind a target that goes `distance` in `time` along a mode [rad or m].
struct ModeErrors {
  double start = 0, reversal = 0;  // at a jump to, and a reversal of, distance/time
  std::array<double, 4> smooth{};  // cubic, quintic, cosine, bang-bang
  double absolute_lag = 0;         // of an absolute damper, at distance/time
  double weld_lag = 0;             // of a mocap weld with this frequency
};

// The largest errors of each joint, by rows, when all targets make the move at once [rad or m]. Not
// a number where nothing holds the joint, or the error has no bound.
struct RowErrors {
  Eigen::VectorXd distance, start, reversal;
  std::array<Eigen::VectorXd, 4> smooth;
  Eigen::VectorXd lag;  // in the long run at distance/time: absolute dampers, friction, delays
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
  bool is_the_scenes = false;
};

struct Predicted {
  std::vector<std::string> rows;
  std::vector<bool> is_angle;  // of rows; else a length
  std::vector<PredictedCoupling> couplings;
  Eigen::MatrixXd M, K, B;  // of all couplings
  std::vector<PredictedMode> modes;
  std::vector<SchemeLimit> limits;
  Integrator integrator = Integrator::semi_implicit;
  std::string stepped;              // how the scene steps them, in words
  double step = 0;                  // [s]
  double max_step = 0;              // of the scene as it is stepped
  double growth = 1;                // of an error in a step; not for dopri5
  Eigen::VectorXd sag;              // by rows; not a number where nothing holds
  std::optional<RowErrors> errors;  // not of robots with very many joints
  std::vector<std::string> warnings;
};

// Throws InputError where there is nothing to be predicted.
Predicted predict_couplings(SimulatePlan& prepared, const PredictTask& task);

std::string predicted_table(const Predicted& found, const PredictTask& task);
std::string predicted_json(const Predicted& found, const PredictTask& task);

}  // namespace twinarm
