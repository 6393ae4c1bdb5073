// First-order error of impacts in steps of fixed size: the impulse has the direction of the contact
// normal at the start of the step, before the flight to the impact.
#pragma once

#include <string>
#include <vector>

#include "collision/contact/contact_constraints.h"

namespace twinarm {

class ImpactNormals {
 public:
  // Call after each step of h.
  void look(const ContactConstraints& contacts, double h);
  // Warning if a normal turned by more than 0.01 rad in the step of an impact; else empty.
  std::string warning() const;

 private:
  struct Impact {
    int a, b, feature;
    Vector3 n_W;
  };
  std::vector<Impact> impacts_;  // of the last step, from a gap
  double turn_ = 0;              // largest [rad]
  std::string pair_;
};

}  // namespace twinarm
