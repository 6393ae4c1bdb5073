// Parameters of a scene that can be changed while it runs. For each: its path, as in `replay --set`
// and `map`, its value, a valid range, and for gains, step and rate the stability limit and
// tracking error predicted by linear theory at the present state.
//
// A limit is where the spectral radius of the actual step (coupling/analysis/step_matrix.h) exceeds
// 1, with all couplings and all other parameters as they are. Contacts, constraints and the
// geometric stiffness of points far from their targets are not included.
//
// Cost: parameters_of() below 0.1 ms; predict_limits() of the S-103 with four couplings below 5 ms.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/data/json_writer.h"
#include "app/run/simulate_input.h"

namespace twinarm {

struct ParameterLimit {
  std::optional<double> value;  // none: any value is stable, or no value
  std::string words;
  std::string_view state = "ok";  // "near": more than three quarters of it; "beyond"
};

struct LabParameter {
  std::string path, label, group;
  // Of a coupling: its index in the scene, -1 for all, and its key.
  std::optional<int> coupling;
  std::string key;
  std::optional<double> number;  // value; none: not in the scene; of a rate: "every step"
  std::string text;              // value of a choice
  // VALUE in the scene as opened; empty: not given there; none: that scene has no such parameter.
  std::optional<std::string> initial;
  std::string unit;
  // log, linear: sliders from low to high; number: typed; choice: one of `choices`.
  std::string_view form = "number";
  double low = 0, high = 0;  // of the slider; the value may lie outside
  std::vector<std::string> choices;
  std::string description;
  std::optional<ParameterLimit> limit;
  std::string tracking_error;
  // A change keeps only positions and velocities: internal states of couplings and contacts (held
  // forces, differences) are reset.
  bool resets_state = false;
  bool is_folded = false;  // its group is closed until it is asked for

  std::string value() const;  // VALUE of PATH=VALUE; empty if it has none
};

// In the order of the page: time and world, couplings, masses, surfaces. Values not in the file are
// the defaults.
std::vector<LabParameter> parameters_of(const SimulatePlan& plan);

// Fills `initial` from the parameters of the unchanged scene.
void set_initial_values(const std::vector<LabParameter>& unchanged,
                        std::vector<LabParameter>& parameters);

// Adds limits and tracking errors at the state `now`, which is written to the plan; `pose` is
// appended to the limits' words.
void predict_limits(SimulatePlan& plan, const State<double>& now,
                    std::vector<LabParameter>& parameters, const char* pose = "");

// The list `parameters` of docs/reference/lab_protocol.md.
void write_parameters(const std::vector<LabParameter>& parameters, JsonWriter& json);

}  // namespace twinarm
