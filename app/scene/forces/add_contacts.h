// Adds contacts, loop closures and joint limits of a scene to a simulation; their work.
#pragma once

#include "app/robot/robot_input.h"
#include "app/scene/forces/reported_forces.h"
#include "app/scene/model/scene_model.h"
#include "collision/contact/contact_constraints.h"
#include "solver/constraints/joint_limits.h"
#include "solver/stepping/simulation.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// Adds diagnostics for what the integrator cannot simulate.
void check_contacts(const SceneModel& scene, Integrator integrator, DiagnosticList& faults);

// Position limits act with the semi-implicit integrator only; with others a run warns of them.
bool limits_act(const SceneModel& scene, Integrator integrator);

// Whether there is a free body without joints and constraints, and the integrator is semi-implicit.
// The scene is then always stepped as with constraints, which conserves energy and angular momentum
// of that body (docs/understand/contact.md).
bool steps_for_flight(const SceneModel& scene, Integrator integrator);

// contact = "event": events are located in time; steps between them are adaptive.
bool locates_events(const SceneModel& scene);

class SceneContacts {
 public:
  // Keeps references to both. Throws InputError for loops that are open at the start.
  SceneContacts(const SceneModel& scene, Simulation& simulation);
  // `contact/A-B/normal|friction|impact` and `joint/NAME/limit`, with work other than 0.
  std::vector<EnergyRow> rows() const;
  // Of the contacts, summed over the geometries of a link: consecutive ones with the link's name.
  std::vector<ContactWork> work_by_names() const;
  int contact_count() const;   // active contact points at the last step
  double penetration() const;  // largest at the last step [m]
  double deepest_at_start() const { return deepest_at_start_; }  // [m]
  const std::string& deepest_pair() const { return deepest_pair_; }
  // Of the last step; null if the scene has none (limits() may also be empty).
  const ContactConstraints* contacts() const { return contacts_ ? &*contacts_ : nullptr; }
  // Of the whole run; no queries unless the scene gives detection = "fcl".
  CollisionWorld::FclUse fcl_use() const {
    return contacts_ ? contacts_->bodies().world().fcl_use() : CollisionWorld::FclUse();
  }
  const JointLimits* limits() const { return limits_ ? &*limits_ : nullptr; }
  // Whether the last step (side steps included) corrected positions of joint limits only.
  bool only_limits_were_passed() const {
    return limits_ && limits_->needs_position_correction() &&
           !(contacts_ && contacts_->needs_position_correction());
  }

 private:
  void add_geometries();
  void add_limits();
  void find_deepest_contact(const Simulation& simulation);

  const SceneModel& scene_;
  std::optional<ContactConstraints> contacts_;
  std::optional<JointLimits> limits_;
  double deepest_at_start_ = 0;
  std::string deepest_pair_;
};

// Warns once per joint that is beyond its limits, where limits do not act.
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
    bool is_reported = false;
  };
  std::vector<Limit> limits_;
  std::vector<std::string>& warnings_;
};

}  // namespace twinarm
