// Contents of the message `state` (docs/reference/lab_protocol.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/diagnose/post_mortem.h"
#include "app/lab/run/variants.h"

namespace twinarm {

struct LabNote {
  long number = 0;
  std::string level, text;  // "note", "warning", "error"
};

// A run that diverged or was stopped by its energy, with suggested fixes.
struct RunFailure {
  double time = 0;  // of the last good state [s]
  double from = 0;  // instant from which to branch with a fix [s]
  std::vector<std::string> words;
  bool trying = true;                  // fixes are being tried (app/lab/run/remedy_trial.h)
  std::vector<SuggestedFix> remedies;  // those that hold
};

struct LabBranch {
  double from = 0;  // [s]
  std::vector<Change> changes;
  int number = 0;  // counts branches
};

struct OperatorStatus {
  std::string source;           // scene, drag, joints, device; empty: no coupling can be driven
  std::string spec;             // of a device, as requested
  std::string mapping, device;  // device: description
  std::vector<double> q;        // targets of the driven joints
  std::string mode;             // of a device: live, held, released; empty: no device
  bool gripper_closed = false;  // as set by the user; of sources scene and device: as theirs
};

struct LabStatus {
  long scene = 0;               // counts opened scenes
  std::string scene_name;       // of the gallery, or the file's
  std::vector<Change> changes;  // to the scene's file
  VariantSet variants;
  std::vector<std::optional<double>> variant_ends;  // from the second on: time of its stop [s]
  bool playing = true;
  double speed = 1;
  double time = 0, first = 0, last = 0;  // present; range of the history [s]
  std::optional<double> at;              // the earlier instant that is shown
  std::optional<LabBranch> branch;
  double pace = 1, step = 0, step_time = 0;  // real-time factor over speed; [s], [s]
  OperatorStatus hand;
  std::optional<RunFailure> failure;
  std::vector<LabNote> notes;  // the last twenty
};

}  // namespace twinarm
