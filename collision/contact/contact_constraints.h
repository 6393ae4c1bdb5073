// Contacts of everything with everything, as constraints of the solver
// (solver/stepping/constrained_step.h).
//
// Two responses, chosen for all contacts of an instance:
//   rigid      no penetration, restitution e (Newton's law, impacts faster than 1 mm/s), exact
//              Coulomb cones; optional torsional and rolling friction
//   compliant  Hunt-Crossley normal force, N = k d (1 + c s), and bristles that stick at rest and
//              slip at mu N; both at the end of the step, so stable at any stiffness. The bound mu
//              N is that of the last round, which at the end is this step's own.
// Moving bodies are found as far ahead as they move within a step, and gaps may close but not more:
// nothing tunnels, whatever its speed. What is struck is looked for again at its new speed.
#pragma once

#include <vector>

#include "collision/contact/contact_active_set.h"
#include "collision/contact/contact_bodies.h"
#include "collision/contact/contact_manifolds.h"
#include "collision/contact/contact_rows.h"
#include "solver/support/checkpointable.h"

namespace twinarm {

class ContactConstraints final : public ConstraintSource, public Checkpointable {
 public:
  ContactConstraints(const Model<double>& model, ContactResponse response);
  ContactConstraints(const ContactConstraints&) = delete;  // its parts know each other
  ContactConstraints& operator=(const ContactConstraints&) = delete;

  ContactBodies& bodies() { return bodies_; }
  const ContactBodies& bodies() const { return bodies_; }

  void begin_step(const Kinematics& k, const State<double>& x, double h) noexcept override;
  bool has_closing_contact(const ConstraintFrame& frame) noexcept override;
  bool extend_detection(const Kinematics& k, double h) noexcept override;
  bool needs_position_correction() const noexcept override;
  void add(const ConstraintFrame& frame, ImpulseProblem& problem) noexcept override;
  void take(const ConstraintFrame& frame, const ImpulseProblem& problem,
            std::size_t first) noexcept override;
  EventSource* events() override { return &active_; }
  void serialize(StateArchive& memory) override;

  const std::vector<ContactPoint>& points() const { return found_.points; }
  // Of all steps so far, ascending by (a, b).
  const std::vector<ContactWork>& work() const { return works_.all; }

  static constexpr double kSlop = ContactRows::kSlop;

 private:
  void take_step(const ConstraintFrame& frame, const ImpulseProblem& problem,
                 const ContactRows::Part& part, const Matrix3& axes);

  ContactResponse response_;
  ContactBodies bodies_;
  ContactManifolds found_;
  ContactRows rows_;
  ContactWorks works_;
  ContactActiveSet active_;
};

}  // namespace twinarm
