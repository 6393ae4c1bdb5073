// What a person is asked to do, and what came of it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/scene/model/scene_model.h"
#include "app/servo/servo_loop.h"
#include "solver/spatial/pose.h"

namespace twinarm {

// A robot as a person meets it.
struct TrialCondition {
  std::string name, title;      // "E1", for people
  std::filesystem::path scene;  // as a file
  bool is_kinematic = false;    // the kinematic robot alone: no mass, no force, no error
};

struct TrialResult {
  std::string condition, task;
  double seconds = 0;  // that the task took
  bool is_done = false;
  int picks = 0, drops = 0;
  double picked_at = -1, off_mm = 0;
  std::vector<double> max_deg, mean_deg;  // |q_K - q_D| of joints 1 and 2; empty: kinematic
  std::string log;
};

struct TrialTask {
  bool is_pick_and_place = false;
  double seconds = 20;  // of free motion; the most that the other may take
  bool real_time = true;
  bool (*is_stopped)() = nullptr;  // asked as often; true ends it early, and what was done is kept
  // Some twenty times a second: a picture of the table. May be empty.
  std::function<void(const std::string& picture, double t)> show;
};

// One task under one condition. Throws InputError.
TrialResult run_task(const TrialCondition& condition, HandDevice& device,
                     const MappingSpec& mapping, const TrialTask& task,
                     const std::filesystem::path& log);

// What a trial leaves: a table for people, JSON, and one CSV of all subjects that names none of
// them.
struct TrialReport {
  std::string subject;  // a code, never a name
  std::string device, mapping;
  std::vector<TrialResult> results;  // in the order in which they were done
  std::string csv;
};

std::string trial_table(const TrialReport& report);
std::string trial_json(const TrialReport& report);
// Adds the row of the last result to a file of earlier ones. Throws InputError where the file is
// there and is no such table.
void add_last_to_csv(const TrialReport& report, const std::filesystem::path& file);
// "S1", or the next that the file has not.
std::string next_subject(const std::filesystem::path& file);

// A task for a person: bring an object from one place of the table to another.
//
// It is told from above: the gripper takes the object where the button is pressed within `reach` of
// it, carries it while the button is held, and has placed it where it is let go within `reach` of
// the goal. Let go elsewhere, it lies there. The object has no mass: what is measured is how well
// the robot goes where the hand wants it.
class PickAndPlace {
 public:
  struct Places {
    Vector3 object{0.42, 0.28, 0}, goal{0.42, -0.28, 0};  // world [m]; z is not looked at
    double reach = 0.03;                                  // [m]
  };
  explicit PickAndPlace(const Places& places) : places_(places), object_(places.object) {}

  // Once a tick, at its time [s]: where the gripper is, and whether it is closed.
  void tick(double t, const Vector3& gripper, bool closed);

  const Vector3& object() const { return object_; }
  const Places& places() const { return places_; }
  bool is_carried() const { return carried_; }
  bool is_placed() const { return placed_; }
  int picks() const { return picks_; }
  int drops() const { return drops_; }          // beside the goal
  double picked_at() const { return picked_; }  // for the first time [s]; negative: never
  double placed_at() const { return done_; }    // likewise
  double off() const;                           // the object from the goal [m]

 private:
  Places places_;
  Vector3 object_;
  bool carried_ = false, placed_ = false, closed_ = false;
  int picks_ = 0, drops_ = 0;
  double picked_ = -1, done_ = -1;
};

}  // namespace twinarm
