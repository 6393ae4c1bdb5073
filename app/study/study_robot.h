// A robot as the study runs it: models of both its copies, and the springs that couple them.
#pragma once

#include <string>
#include <vector>

#include "app/study/settings.h"
#include "collision/import/robot/robot_description.h"
#include "collision/import/robot/robot_model.h"
#include "coupling/analysis/tracking_run.h"
#include "solver/forces/joint_stops.h"

namespace twinarm {

class StudyRobot {
 public:
  // The S-103 of the settings. arm2_mass_scale multiplies the assumed mass of everything outward
  // of joint 2; the paper publishes no mass.
  static StudyRobot s103(const StudySettings& settings, const RobotDescription& description,
                         double arm2_mass_scale = 1);
  // A two-link robot of the findings; springs at the centres of mass, no added masses.
  static StudyRobot findings(const RobotDescription& description);

  const std::string& name() const { return name_; }
  const Model<double>& kvr_model() const { return kvr_model_; }
  // With the added masses, for linear couplings; without them, for torsional ones.
  const Model<double>& dvr_model(CouplingSpec::Type type) const {
    return type == CouplingSpec::Type::torsional ? dvr_plain_ : dvr_weighted_;
  }
  // What they were made with.
  const ModelOptions& masses(CouplingSpec::Type type) const {
    return type == CouplingSpec::Type::torsional ? plain_ : weighted_;
  }
  const DrivenJoints& joints() const { return joints_; }

  // The two springs of the studied coupling, on the links of joints 1 and 2.
  std::vector<Spring> springs(double k1, double b1, double k2, double b2) const;
  // Joint 3 and the gripper, held in every run; empty for a two-link robot.
  const std::vector<CouplingSpec>& auxiliary() const { return auxiliary_; }
  const std::vector<JointStops::Stop>& stops() const { return stops_; }

  // Inertia of joints 1 and 2, the others locked, at the start of the automatic motion.
  Eigen::Matrix2d start_inertia(CouplingSpec::Type type) const;
  State<double> start_state() const;

 private:
  std::string name_;
  ModelOptions plain_, weighted_;
  Model<double> kvr_model_, dvr_plain_, dvr_weighted_;
  DrivenJoints joints_;
  std::vector<Mount> mounts_;
  std::vector<CouplingSpec> auxiliary_;
  std::vector<JointStops::Stop> stops_;
};

}  // namespace twinarm
