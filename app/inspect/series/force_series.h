// Accelerations, joint reactions and named forces along a run, by the ABA of `twinarm inspect`.
//
// World axes. Forces are those of a step that starts at the instant, as in `inspect`: of the run's
// step where forces are implicit in it or bodies touch, else of a microsecond.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/inspect/inspection.h"
#include "app/inspect/report/inspect_output.h"
#include "app/run/stepped_run.h"

namespace twinarm {

class ForceSeries {
 public:
  // Prepares the run of these options again: an inspection changes its input.
  explicit ForceSeries(const SimulateOptions& options);

  // Before the first step and after each (RunWatch::look): keeps what a sample within the next step
  // needs.
  void keep(SteppedRun& run);
  // At a state of the run before the next call of keep().
  void read(const State<double>& x);

  // Of the last read(): "qdd", "accelerations" of the links, "joint_forces", "forces".
  void write(JsonWriter& json) const;
  // Those with a fixed place: qdd, accelerations, wrenches of joints, constraints and springs, sum
  // of contacts on each body.
  std::vector<RunColumn> columns() const;
  std::vector<double> values() const;

 private:
  struct Wrench6 {
    Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
  };
  Vector3 angular_acceleration(std::size_t body) const;
  // About the link's origin.
  Wrench6 in_world(const Force<double>& f, std::size_t body) const;
  // Of the parent on the body through its joint, about the link's origin.
  Wrench6 joint_wrench(std::size_t body) const;
  // About its point of application.
  Wrench6 wrench_of(const std::string& force, std::size_t body) const;
  double torque_of(const std::string& force, std::size_t body) const;  // [N m, N]
  std::vector<Wrench6> sums_of_contacts() const;

  SimulatePlan plan_;
  std::optional<SceneInspector> scene_;  // none: a robot alone
  std::string memory_;
  struct OnBody {
    std::string force;
    std::size_t body;  // a, or b where a is the world
  };
  std::vector<OnBody> named_;          // constraints and springs between bodies
  std::vector<OnBody> on_joints_;      // gears and motions: child of joint a
  std::vector<std::size_t> jointed_;   // bodies whose joint carries forces
  std::vector<std::size_t> touching_;  // bodies that may touch
  std::optional<Inspection> now_;
};

// Columns of a run, and their values at x; with those of `forces` unless it is null.
std::vector<RunColumn> run_columns(const RobotInput& input, const ForceSeries* forces);
std::vector<double> run_values(const RobotInput& input, const State<double>& x, const Kinematics& k,
                               ForceSeries* forces);

}  // namespace twinarm
