// Contacts, loop closures and joint limits of a scene: into the simulation, and their work.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/robot/robot_input.h"
#include "app/scene/forces/reported_forces.h"
#include "app/scene/model/scene_model.h"
#include "collision/contact/contact_constraints.h"
#include "solver/impulses/joint_limits.h"
#include "solver/stepping/simulation.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// What this program cannot compute of the scene, with that integrator.
void check_contacts(const SceneModel& scene, Integrator integrator, DiagnosticList& faults);

// Position limits go with the semi-implicit integrator alone; with others a run warns of them.
bool limits_act(const SceneModel& scene, Integrator integrator);

// With the semi-implicit integrator: whether a free body is there that no joint and no constraint
// ties to anything. Steps under constraints keep its energy and angular momentum in flight
// (docs/understand/contact.md), so all steps of the scene are such, though nothing may touch.
bool steps_for_flight(const SceneModel& scene, Integrator integrator);

// contact = "event": steps locate their events in time, and are adaptive between them.
bool locates_events(const SceneModel& scene);

class SceneContacts {
 public:
  // Both must outlive it. Throws InputError for loops that are open at the start.
  SceneContacts(const SceneModel& scene, Simulation& simulation);
  // `contact/A-B/normal|friction|impact` and `joint/NAME/limit`: what did any work.
  std::vector<EnergyRow> rows() const;
  int contact_count() const;  // points that press, at the last step
  double deepest_at_start() const { return deepest_at_start_; }  // [m]
  const std::string& deepest_pair() const { return deepest_pair_; }
  // Of the last step; null where nothing may touch; limits() may have no limit, or be null.
  const ContactConstraints* contacts() const { return contacts_ ? &*contacts_ : nullptr; }
  const JointLimits* limits() const { return limits_ ? &*limits_ : nullptr; }
  // In the step that was taken last, a side step included: whether joints beyond their limits were
  // moved back, and no bodies apart, which would be one equation.
  bool only_limits_were_passed() const {
    return limits_ && limits_->needs_position_correction() &&
           !(contacts_ && contacts_->needs_position_correction());
  }

 private:
  void add_geometries();
  void add_rules();
  void add_limits();
  void look_at_start(const Simulation& simulation);

  const SceneModel& scene_;
  std::optional<ContactConstraints> contacts_;
  std::optional<JointLimits> limits_;
  double deepest_at_start_ = 0;
  std::string deepest_pair_;
};

// Notes the first time at which a joint stands beyond its limits, which do not act.
class LimitWatch {
 public:
  LimitWatch(const RobotInput& input, bool limits_act, std::vector<std::string>& warnings)
      : warnings_(warnings) {
    if (limits_act) return;
    for (const JointDescription& joint : input.robot.joints) {
      const int body = input.model.find_joint(joint.name);
      if (joint.is_limited() && body > 0)
        limits_.push_back({&joint, input.model.iq[static_cast<std::size_t>(body)]});
    }
  }
  void look(double t, const State<double>& x);

 private:
  struct Limit {
    const JointDescription* joint;
    std::size_t iq;
    bool is_told = false;
  };
  std::vector<Limit> limits_;
  std::vector<std::string>& warnings_;
};

}  // namespace twinarm
