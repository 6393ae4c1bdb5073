// The pictures of the report, painted without display or GPU.
#pragma once

#include <filesystem>

#include "app/study/findings/results.h"
#include "app/support/progress.h"

namespace twinarm {

// Runs the obstacle with both couplings (results.obstacle) and writes, into folder/pictures:
// robot.png, E3.png and E4.png (at the largest error of each), obstacle-linear.png and
// obstacle-torsional.png (while the DVR is stopped). paper_view leaves the ghost out.
void run_obstacles_and_paint(const StudyInputs& inputs, const StudyRobot& robot,
                             StudyResults& results, const std::filesystem::path& folder,
                             bool paper_view, Progress& progress);

}  // namespace twinarm
