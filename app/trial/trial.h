// User study: conditions, tasks and results.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/servo/servo_loop.h"

namespace twinarm {

struct TrialCondition {
  std::string name, title;  // "E1", description
  std::filesystem::path scene;
  bool is_kinematic = false;  // target robot only: no mass, no force, no tracking error
};

struct TrialResult {
  std::string condition, task;
  double seconds = 0;  // duration of the task
  bool is_done = false;
  int picks = 0, drops = 0;
  double picked_at = -1,
         placement_error_mm = 0;          // first pick [s], -1: none; distance from the goal
  std::vector<double> max_deg, mean_deg;  // |q_K - q_D| of joints 1 and 2; empty: kinematic
  std::string log;
};

struct TrialTask {
  bool is_pick_and_place = false;
  double seconds = 20;  // of free motion; timeout of pick-and-place
  bool real_time = true;
  // Called about twenty times a second with a top view in characters. May be empty.
  std::function<void(const std::string& picture, double t)> show;
};

// One task under one condition; Ctrl-C ends it early, its results are kept. Throws InputError.
TrialResult run_task(const TrialCondition& condition, InputDevice& device,
                     const MappingSpec& mapping, const TrialTask& task,
                     const std::filesystem::path& log);

// Table, JSON, and one CSV file of all participants, without names.
struct TrialReport {
  std::string participant;  // a code, never a name
  std::string device, mapping;
  std::vector<TrialResult> results;  // in order
  std::string csv;
};

std::string trial_table(const TrialReport& report);
std::string trial_json(const TrialReport& report);
// Appends the row of the last result. Throws InputError: the file exists with another header.
void add_last_to_csv(const TrialReport& report, const std::filesystem::path& file);
// The first of "S1", "S2", .. that is not in the file.
std::string next_participant(const std::filesystem::path& file);

}  // namespace twinarm
