// Contacts between all geometries as constraints of the solver
// (solver/stepping/constrained_step.h).
//
// Response, the same for all contacts of an instance:
//   rigid      no penetration, restitution e (Newton's law, impacts faster than 1 mm/s), exact
//              Coulomb cones; optional torsional and rolling friction
//   compliant  Hunt-Crossley normal force N = k d (1 + c s), and bristle friction that sticks below
//              mu N and slides at mu N; both at the end of the step: stable at any stiffness
// Detection uses a speculative margin of the distance that bodies move within a step, and the
// constraint is that a gap closes at most: no tunnelling at any speed. After an impact, detection
// is repeated with the new velocities.
#pragma once

#include <vector>

#include "collision/contact/contact_active_set.h"
#include "collision/contact/contact_bodies.h"
#include "collision/contact/contact_manifolds.h"
#include "collision/contact/contact_rows.h"
#include "solver/support/checkpointable.h"

namespace twinarm {

class ContactConstraints : public ConstraintSource, public Checkpointable {
 public:
  ContactConstraints(const Model<double>& model, ContactResponse response);
  ContactConstraints(const ContactConstraints&) = delete;  // parts hold references to each other
  ContactConstraints& operator=(const ContactConstraints&) = delete;

  ContactBodies& bodies() { return bodies_; }
  const ContactBodies& bodies() const { return bodies_; }

  void begin_step(const Kinematics& k, const State<double>&, double h) noexcept override {
    found_.begin_step(k, h);
  }
  bool has_closing_contact(const ConstraintFrame& frame) noexcept override;
  bool extend_detection(const Kinematics& k, double h) noexcept override {
    return found_.extend_detection(k, h);
  }
  bool needs_position_correction() const noexcept override;
  void add_constraints(const ConstraintFrame& frame, ImpulseProblem& problem) noexcept override {
    rows_.add(frame, found_.points, problem);
  }
  void read_impulses(const ConstraintFrame& frame, const ImpulseProblem& problem,
                     std::size_t first) noexcept override;
  EventSource* events() override { return &active_; }
  void serialize(StateArchive& memory) override;

  const std::vector<ContactPoint>& points() const { return found_.points; }
  // Sum over all steps, ascending by (a, b).
  const std::vector<ContactWork>& work() const { return works_.all; }

  static constexpr double kSlop = ContactRows::kSlop;

 private:
  void read_step(const ConstraintFrame& frame, const ImpulseProblem& problem,
                 const ContactRows::Part& part, const Matrix3& axes);

  ContactResponse response_;
  ContactBodies bodies_;
  ContactManifolds found_;
  ContactRows rows_;
  ContactWorks works_;
  ContactActiveSet active_;
};

}  // namespace twinarm
