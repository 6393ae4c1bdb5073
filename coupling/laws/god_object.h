// God object: the DVR has the acceleration that brings it onto the KVR at the end of the step, and
// where it touches something, the nearest one that the contact allows (Zilles and Salisbury 1995
// for a point; Ortega, Redon, Coquillart 2007 in six dimensions, after Gauss's principle):
//
//   a_u = ((q_K' - q)/h - qd)/h                 lands on q_K' : qd' = qd + h a_u, q' = q + h qd'
//   min (a - a_u)^T M (a - a_u)  with  J a >= what the contacts ask for
//
// tau = ID(q, qd, a_u), inverse dynamics in O(n), makes a_u the acceleration without contact; the
// rigid contacts' impulses then change it by M^-1 J^T p, p >= 0: that is the projection in the
// metric of M. Gravity, damping and dry friction of the joints are in tau, so that nothing but
// contacts and limits keeps the DVR off the KVR. There is no spring, no gain, no limit of the step;
// against an obstacle the torque is whatever the way that is lacking asks for: M times it over h^2.
//
// All joints of a robot at once: those that were left out would be thrown about by the others.
// Joints of one degree of freedom only. It belongs to the semi-implicit step: no other treatment.
#pragma once

#include "coupling/laws/coupling.h"

namespace twinarm {

class GodObject final : public Coupling {
 public:
  // One spring for each joint, named by the body that it carries; their gains must be 0. Throws
  // InputError for joints that have not one degree of freedom, or whose neighbours are left out.
  GodObject(std::string name, const Model<double>& model, KinematicRobot& kvr,
            std::vector<Spring> joints);

  void begin_step(const Kinematics& k, double t, double h) noexcept override;
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  bool needs_semi_implicit() const override { return true; }
  JointSpace joint_space(const Kinematics& k) const override;       // zero: there is no spring
  const std::vector<double>& acceleration() const { return a_u_; }  // by velocity

 private:
  void check_joints() const;
  double friction(std::size_t dof, double qd_end) const;

  std::vector<double> a_u_;
  std::vector<Force<double>> no_forces_;
  Workspace<double> w_;
};

// A spring without gains for each joint with degrees of freedom among the bodies.
std::vector<Spring> god_object_joints(const Model<double>& model, int first_body, int last_body);

}  // namespace twinarm
