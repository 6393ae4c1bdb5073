// Recordings of E1 to E4 and of the runs with the obstacle. Each run is written as a scene, which
// is simulated and recorded as by `twinarm simulate --record`, so that a recording can be replayed
// and branched with the laws of the study. The difference between the angles of scene and study is
// measured.
#pragma once

#include <filesystem>

#include "app/study/calibration/calibration.h"
#include "app/study/findings/results.h"
#include "app/study/study_scene.h"

namespace twinarm {

// Into `folder`: NAME.toml, NAME.twinrec and, if the program contains its pages, NAME.html.
std::vector<StudyRecording> write_recordings(const StudyInputs& inputs, const StudyRobot& robot,
                                             const StudyOperator& hand, const StudyResults& results,
                                             const std::filesystem::path& folder,
                                             Progress& progress);

// Pictures of results.recordings: robot.png, E3.png and E4.png (at their largest errors),
// obstacle-linear.png and obstacle-torsional.png (while the DVR is stopped), rendered without
// display or GPU. paper_view omits the KVR and the springs.
void paint_pictures(const StudyResults& results, const std::filesystem::path& folder,
                    bool paper_view, Progress& progress);

}  // namespace twinarm
