// What can be turned in a scene while it runs: for each knob its path, as `replay --set` and `map`
// write it, its value now, a range that gives a scene, and, beside gains, step and rate, the limit
// and the lag that linear theory predicts about the present state.
//
// The limit of a knob is where an error begins to grow in the step as it is really taken
// (coupling/analysis/step_matrix.h), all couplings together, all other knobs as they stand.
// Contacts and constraints are left out, and so is the geometric stiffness of points that are far
// from their targets: the limit is about zero offset, in the pose of the moment.
//
// Cost: knobs_of less than 0.1 ms; predict_knobs of the S-103 with four couplings less than 5 ms of
// processor time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/data/json_writer.h"
#include "app/run/simulate_input.h"

namespace twinarm {

struct ParameterLimit {
  enum class State { ok, near, beyond };  // near: less than a quarter of it is left
  std::optional<double> value;            // in the knob's unit; none: any value holds, or none
  std::string words;
  State state = State::ok;
};

struct LabParameter {
  // log and linear are sliders from low to high; number is typed; choice is one of `choices`.
  enum class Form { log, linear, choice, number };
  std::string path, label, group;
  // Of a coupling: its number in the scene, -1 for all of them, and its key.
  std::optional<int> coupling;
  std::string key;
  std::optional<double>
      number;        // value now; none: as the scene leaves it out, "every step" of a rate
  std::string text;  // value now of a choice
  // VALUE of the scene as it was opened, as change() writes it; empty: that leaves it out; none:
  // that has no such knob.
  std::optional<std::string> start;
  std::string unit;
  Form form = Form::number;
  double low = 0, high = 0;  // what a slider offers; the value may lie outside
  std::vector<std::string> choices;
  std::string meaning;
  std::optional<ParameterLimit> limit;
  std::string lag;
  // The run goes on from coordinates and velocities alone: what laws remember of past steps
  // (held forces, differences, contacts) begins anew.
  bool restarts = false;

  std::string value() const;   // as VALUE of PATH=VALUE; empty where it has none
  std::string change() const;  // "PATH=VALUE" as it stands; likewise
};

// In the order of a page: time and world, robots, couplings, surfaces. Values that the file leaves
// out are those of its reader.
std::vector<LabParameter> knobs_of(const SimulatePlan& plan);

// Fills `start` from the knobs of the scene without changes.
void know_starts(const std::vector<LabParameter>& unchanged, std::vector<LabParameter>& knobs);

// Adds limits and lags about `now`. The plan is the caller's own: its state is set to `now`.
void predict_knobs(SimulatePlan& plan, const State<double>& now, std::vector<LabParameter>& knobs);

// The list `knobs` of docs/reference/lab_protocol.md.
void write_knobs(const std::vector<LabParameter>& knobs, JsonWriter& json);

}  // namespace twinarm
