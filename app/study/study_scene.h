// A run of the study as a scene file (docs/reference/scene_file.md).
#pragma once

#include <string>

#include "app/data/value.h"
#include "app/study/study_run.h"

namespace twinarm {

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
