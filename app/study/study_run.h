// One run of the study: specification, result and prediction.
#pragma once

#include "app/data/value.h"
#include "app/study/settings.h"
#include "collision/import/robot/robot_model.h"
#include "coupling/analysis/prediction.h"
#include "solver/forces/joint_stops.h"

namespace twinarm {

// Gains of the studied coupling on the links of joints 1 and 2.
struct Gains {
  double k1 = 0, b1 = 0, k2 = 0, b2 = 0;
  static Gains both(double k, double b) { return {k, b, k, b}; }
};

// A robot of the study: models of KVR and DVR, and the springs between them.
class StudyRobot {
 public:
  // The S-103 of the settings. arm2_mass_scale multiplies the assumed masses of the descendants of
  // joint 2; the paper publishes no masses.
  static StudyRobot s103(const StudySettings& settings, const RobotDescription& description,
                         double arm2_mass_scale = 1);
  // A two-link robot; springs at the centres of mass, no added masses.
  static StudyRobot findings(const RobotDescription& description);

  const std::string& name() const { return name_; }
  const Model<double>& kvr_model() const { return kvr_model_; }
  // With the added masses for linear couplings, without them for torsional ones.
  const Model<double>& dvr_model(CouplingSpec::Type type) const {
    return type == CouplingSpec::Type::torsional ? dvr_plain_ : dvr_weighted_;
  }
  // Mass options of dvr_model().
  const ModelOptions& masses(CouplingSpec::Type type) const {
    return type == CouplingSpec::Type::torsional ? plain_ : weighted_;
  }
  const DrivenJoints& joints() const { return joints_; }

  // The two springs of the studied coupling, on the links of joints 1 and 2.
  std::vector<Spring> springs(const Gains& gains) const;
  // Couplings of joint 3 and the gripper, in every run; empty for a two-link robot.
  const std::vector<CouplingSpec>& auxiliary() const { return auxiliary_; }
  const std::vector<JointStops::Stop>& stops() const { return stops_; }

  // Inertia of joints 1 and 2, all others locked, at the start of the automatic motion.
  Eigen::Matrix2d start_inertia(CouplingSpec::Type type) const;
  // Of the automatic motion, after this share of its first sweep.
  State<double> pose_of_motion(double share) const;
  State<double> start_state() const { return pose_of_motion(0); }

 private:
  std::string name_;
  ModelOptions plain_, weighted_;
  Model<double> kvr_model_, dvr_plain_, dvr_weighted_;
  DrivenJoints joints_;
  std::vector<Mount> mounts_;
  std::vector<CouplingSpec> auxiliary_;
  std::vector<JointStops::Stop> stops_;
};

struct RunSpec {
  std::string name;       // "E3", "torsional-vector-60Hz", ...
  std::string title;      // in the report
  CouplingSpec coupling;  // its springs are set from the gains
  Gains gains;
  double rate = 60;       // of the coupling [Hz]
  int held_substeps = 1;  // physics steps per coupling evaluation
  TargetRates kvr_rates = TargetRates::from_operator;
  Integrator integrator = Integrator::semi_implicit;
  RunSpec with_gains(const Gains& other) const {
    RunSpec spec = *this;
    spec.gains = other;
    return spec;
  }
  double step() const { return 1 / (rate * held_substeps); }
  const char* coupling_force_unit() const {  // of the coupling
    return coupling.type == CouplingSpec::Type::linear ? "N" : "N m";
  }
};

struct RunResult {
  RunSpec spec;
  TrackingSeries series;
  std::array<double, 2> max_deg{}, mean_deg{};
  bool stable = false;  // finite, and errors below 180 degrees
  double largest_deg() const { return std::max(max_deg[0], max_deg[1]); }

  // Linear theory about a pose, by predict().
  std::array<double, 2> frequency{};      // natural [rad/s], ascending
  std::array<double, 2> damping_ratio{};  // of these modes
  double step_limit = 0;  // largest stable interval between evaluations of the coupling [s]
  std::array<double, 2> peak_deg{};  // predicted error after a reversal of the automatic motion
  // Of the whole automatic motion, with all its velocity steps.
  std::array<double, 2> motion_max_deg{}, motion_mean_deg{};
  double interval() const { return 1 / spec.rate; }  // to compare with step_limit [s]
};

// KVR, DVR, studied coupling with the gains, auxiliary couplings.
TrackingSetup tracking_setup(const StudyRobot& robot, const OperatorMotion& hand,
                             const RunSpec& spec);
RunResult run(const StudyRobot& robot, const OperatorMotion& hand, const RunSpec& spec);
void predict(const StudyRobot& robot, RunResult& result, const State<double>& pose);
// Largest stable interval between evaluations of the coupling [s] by linear theory: the smallest
// over the poses of the automatic motion.
double step_limit_of_motion(const StudyRobot& robot, const RunSpec& spec);
// Peak after a reversal by linear theory, sum of both joints [deg]: the largest over those poses.
double reversal_peak_of_motion(const StudyRobot& robot, const RunSpec& spec);

inline constexpr double kUnstable = 1e6;  // objective of unstable gains
// Objective of the searches: errors for several sweep times T, weighted by T, so that no resonance
// with one T is exploited.
struct ProtocolErrors {
  std::array<double, 2> max_deg{}, mean_deg{};  // max over T of T max_i, mean over T of T mean_i
  double objective = 0;                         // max over T of T (max_1 + max_2), or kUnstable
};
ProtocolErrors run_protocol(const StudyRobot& robot, const RunSpec& spec,
                            const std::vector<double>& sweep_times);

std::vector<double> in_degrees(std::vector<double> radians);
// |q_K - q_D| of a joint over time.
std::vector<double> error_deg(const TrackingSeries& series, std::size_t joint);
std::string coupling_words(const CouplingSpec& spec);       // "torsional, world orientation"
const char* discretization_name(const CouplingSpec& spec);  // "as printed", "explicit", ...

// A run of the study as a scene file (docs/reference/scene_file.md).

// Motion of the KVR: value of a coupling's `target`.
struct StudyOperator {
  Value target;
  const OperatorMotion* source = nullptr;  // the same motion
};
StudyOperator automatic_operator();
StudyOperator synthetic_study_operator(const OperatorMotion& source, unsigned seed,
                                       const SyntheticRanges& ranges);
// A live input device; the robot starts where all device angles are zero.
StudyOperator device_operator();
StudyOperator traced_operator(const OperatorMotion& source, const std::filesystem::path& trace);

struct StudyScene {
  const StudySettings* settings = nullptr;
  const StudyRobot* robot = nullptr;
  RunSpec spec;
  StudyOperator hand;
  const StudySettings::Obstacle* obstacle = nullptr;  // with contacts; null: none
};
std::string scene_text(const StudyScene& scene);

}  // namespace twinarm
