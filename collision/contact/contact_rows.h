// Contact points as constraints (rows) of the impulse problem, by phase of a step.
#pragma once

#include <vector>

#include "collision/contact/contact_bodies.h"
#include "solver/constraints/constraint_source.h"

namespace twinarm {

class ContactRows {
 public:
  ContactRows(const Model<double>& model, const ContactBodies& bodies, ContactResponse response);

  struct Part {  // constraints of one contact point
    std::size_t point;
    std::size_t row;  // index of its first constraint
    int extra;        // number of torsional and rolling friction constraints that follow
  };
  void add(const ConstraintFrame& frame, const std::vector<ContactPoint>& points,
           ImpulseProblem& problem);
  const std::vector<Part>& parts() const { return parts_; }  // in the order of addition

  // Allowed closing speed: gap/h in a fixed step; in a smooth segment only a correction of the
  // integration error.
  double allowed_closing_speed(const ConstraintFrame& frame, const ContactPoint& point) const;

  static constexpr double kSlop = 1e-6;  // penetration without position correction [m]

 private:
  bool takes_part(const ConstraintFrame& frame, const ContactPoint& point) const;
  void add_contact(const ConstraintFrame& frame, const ContactPoint& point, std::size_t index,
                   ImpulseProblem& problem);
  double bounce_speed(const ContactPoint& point, double u, const ConstraintFrame& frame,
                      const ImpulseProblem& problem, const ImpulseConstraint& c) const;
  void add_friction_couples(const ConstraintFrame& frame, const ContactPoint& point,
                            const Matrix3& axes, ImpulseProblem& problem);

  const ContactBodies& bodies_;
  ContactResponse response_;
  bool has_drives_ = false;
  std::vector<Part> parts_;
};

}  // namespace twinarm
