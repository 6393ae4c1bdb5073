// Contact points as rows of the impulse problem, in each phase of a step.
#pragma once

#include <vector>

#include "collision/contact/contact_bodies.h"
#include "solver/impulses/constraint_source.h"

namespace twinarm {

class ContactRows {
 public:
  ContactRows(const Model<double>& model, const ContactBodies& bodies, ContactResponse response);

  struct Part {  // a contact's share of the problem
    std::size_t point;
    std::size_t row;  // of its constraint
    int extra;        // constraints for torsional and rolling friction behind it
  };
  void add(const ConstraintFrame& frame, const std::vector<ContactPoint>& points,
           ImpulseProblem& problem);
  const std::vector<Part>& parts() const { return parts_; }  // as they were added

  // How fast the gap may close: in a step by what is left of it, in a smooth piece not at all but
  // for the rest that integration leaves.
  double allowed_closing_speed(const ConstraintFrame& frame, const ContactPoint& point) const;

  static constexpr double kSlop = 1e-6;  // penetration that is let be [m]

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
