// Settings of the study, from assets/study/settings.toml.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "collision/import/robot/robot_description.h"
#include "coupling/analysis/tracking.h"
#include "coupling/target/synthetic_operator.h"
#include "coupling/target/target_robot.h"
#include "solver/model/model.h"

namespace twinarm {

struct Mount {  // point of an added mass and of a linear spring
  std::string link;
  Vector3 p_L = Vector3::Zero();  // [m]
};

struct StudySettings {
  std::filesystem::path assets;  // folder to which all other paths are relative
  std::filesystem::path urdf;
  DrivenJoints joints;
  double added_mass = 0;  // [kg]
  std::vector<Mount> mounts;

  double auxiliary_frequency_hz = 0, auxiliary_damping_ratio = 0;
  double stop_stiffness = 0, stop_damping = 0;

  std::vector<double> rates_hz, search_rates_hz, identification_rates_hz, sweep_times;
  double held_physics_hz = 0, implicit_frequency_hz = 0, implicit_damping_ratio = 0;

  // Synthetic operators of E1 and E2: the first seed, and how many from it on.
  unsigned seed = 1, seeds = 0;
  double operator_duration = 0;  // [s]
  SyntheticRanges operator_ranges;

  struct Obstacle {
    Vector3 size = Vector3::Zero(), position = Vector3::Zero();
  } obstacle;
  double contact_stiffness = 0, contact_dissipation = 0, contact_friction = 0;
  // An obstacle that stops the robot where the target gets far from the springs' attachments, and
  // the implicit linear coupling of the run.
  struct FarTarget {
    Obstacle obstacle;
    double rate_hz = 0, frequency_hz = 0, damping_ratio = 0;
  } far_target;
};

// Throws InputError with all missing and invalid entries.
StudySettings read_settings(const std::filesystem::path& assets);

}  // namespace twinarm
