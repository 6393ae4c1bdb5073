// What the page is told of the run besides its frames: the message `state` (docs/reference/lab_protocol.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/diagnose/post_mortem.h"
#include "app/lab/run/variants.h"
#include "app/record/unpack.h"

namespace twinarm {

struct LabNote {
  long number = 0;
  std::string level, text;  // "note", "warning", "error"
};

// A run that stopped by itself, and what would have held.
struct LabEnd {
  double time = 0;  // of the last good state [s]
  double from = 0;  // the last change, or the start: to go on from with a remedy [s]
  std::vector<std::string> words;
  std::string quantity, body, spring;
  std::vector<SuggestedFix> remedies;
};

struct LabBranch {
  double from = 0;  // [s]
  std::vector<Change> changes;
  int number = 0;  // counts branches
};

// Who moves the robot.
struct LabHandStatus {
  std::string source;         // scene, drag, joints, device; empty: no hand leads this scene
  std::string spec;           // of a device, as it was asked for
  std::string mapping, felt;  // felt: what device it is
  std::vector<double> q;      // where the driven joints are told to stand
  std::string mode;           // of a device: live, held, released; empty: there is none
  bool gripper_closed =
      false;  // as the user holds it; where the scene or a device moves: as theirs
};

struct LabStatus {
  long scene = 0;               // counts scenes: of frames, meshes, channels
  std::string scene_name;       // of the gallery, or the file's
  std::vector<Change> changes;  // to the scene's file
  VariantSet lanes;
  std::vector<std::optional<double>> lane_ends;  // from the second on: where one stopped [s]
  bool playing = true;
  double speed = 1;
  double time = 0, first = 0, last = 0;  // now; what is remembered [s]
  std::optional<double> at;              // the instant that is looked at
  std::optional<LabBranch> branch;
  double pace = 1, step = 0, step_time = 0;  // real-time factor; [s], [s]
  LabHandStatus hand;
  std::optional<LabEnd> dead;
  std::vector<LabNote> notes;  // the last twenty
  std::string building;        // what is being prepared, in words; empty: nothing
};

}  // namespace twinarm
