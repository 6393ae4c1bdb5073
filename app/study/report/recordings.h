// E1 to E4 and the runs with the obstacle, recorded: each is written as a scene, and that scene is
// run and recorded as `twinarm simulate --record` does. So whoever opens a recording, or forks it,
// runs the very same laws; and how far the scene's angles part from the study's is measured.
#pragma once

#include <filesystem>

#include "app/study/calibration/calibration.h"
#include "app/study/findings/results.h"
#include "app/study/study_scene.h"

namespace twinarm {

// Into `folder`: NAME.toml, NAME.twinrec and, where the program has its pages, NAME.html.
std::vector<StudyRecording> write_recordings(const StudyInputs& inputs, const StudyRobot& robot,
                                             const SceneHand& hand, const StudyResults& results,
                                             const std::filesystem::path& folder,
                                             Progress& progress);

// Of results.recordings: robot.png, E3.png and E4.png (at the largest error of each),
// obstacle-linear.png and obstacle-torsional.png (while the DVR is stopped), painted without
// display or GPU. paper_view leaves the KVR and the springs out.
void paint_pictures(const StudyResults& results, const std::filesystem::path& folder,
                    bool paper_view, Progress& progress);

}  // namespace twinarm
