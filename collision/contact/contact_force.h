// Hunt-Crossley contact of the study alone; scenes: contact_constraints.h.
//
// Contact of moving links with fixed obstacles: Hunt-Crossley normal force and regularised Coulomb
// friction, both evaluated at the end of the step: stable at any stiffness
// (solver/forces/spring.h).
//
// d: penetration depth, s = d' its rate, positive while closing. After the step d' = d + h s.
//   normal     N = k d' (1 + c s)           where d' > 0 and 1 + c s > 0, else 0
//              (Hunt and Crossley 1975, exponent 1: flat faces). An impact at speed v has the
//              restitution e of  c v - ln(1 + c v) = -c e v - ln(1 - c e v),
//              which is 1 - (2/3) c v to first order
//   friction   T = -mu N_last v_t / sqrt(|v_t|^2 + v_s^2)
//              N_last: normal force of the same contact one step before (with N of this step the
//              fixed-point iteration would oscillate)
// N is linearised about the rate s0 of the last iteration, N = N0 + N' (s - s0), with s = s_n + h J
// qdd: an explicit force and an added mass m* = h N' along the normal. Friction is an implicit
// damper with the factor mu N_last / sqrt(|v_t0|^2 + v_s^2) of the last iteration. Forces and ABA
// are iterated until s converges (Newton's method). A contact that is still open takes part if the
// step would close it.
#pragma once

#include <vector>

#include "collision/detection/collision_world.h"
#include "solver/forces/force_source.h"

namespace twinarm {

struct ContactLaw {
  double k = 1e8;                // stiffness of one contact point [N/m]
  double dissipation = 1;        // c [s/m]
  double friction = 0.3;         // mu
  double stiction_speed = 1e-3;  // v_s [m/s]: below it friction acts as a damper
};

struct ContactReading {
  Contact contact;  // at the start of the step
  int body = 0;     // moving link
  Vector3 p_W = Vector3::Zero();
  Vector3 normal_W = Vector3::Zero();    // out of the obstacle
  double normal_force = 0;               // N at the end of the step [N]
  Vector3 friction_W = Vector3::Zero();  // on the link [N]
};

class ContactForce final : public ForceSource {
 public:
  ContactForce(const Model<double>& model, const ContactLaw& law);

  // A shape of a link (body > 0) or of a fixed obstacle (body 0), at X_LG in its link.
  void add(int body, const Pose& X_LG, const std::string& name, const Shape& shape);

  void begin_step(const Kinematics& k, double t, double h) noexcept override;
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  bool refine(const Kinematics& k, const Workspace<double>& w) noexcept override;
  bool needs_semi_implicit() const override { return true; }
  bool needs_iterations() const override { return true; }

  const std::vector<ContactReading>& readings() const { return readings_; }  // of the last step
  // Maximum penetration depth at a pose, 0 without penetration [m].
  double deepest(const Kinematics& k);

 private:
  struct Piece {
    int body;
    Pose X_LG;
  };
  struct Point {                     // state of a contact during a step
    double s_n = 0, s0 = 0;          // closing rate at the start and at the last iteration [m/s]
    Vector3 v_t0 = Vector3::Zero();  // sliding velocity at the last iteration [m/s]
    Vector3 v_n = Vector3::Zero();   // velocity of the link's point at the start [m/s]
    double N_last = 0;               // normal force one step before [N]
  };
  void find_contacts(const Kinematics& k, double margin);
  double last_normal_force(const Contact& contact) const;

  const Model<double>& model_;
  ContactLaw law_;
  CollisionWorld world_;
  std::vector<Piece> pieces_;
  std::vector<Pose> X_WG_;
  std::vector<Contact> contacts_;
  std::vector<ContactReading> readings_, last_readings_;  // sorted by (a, b, feature)
  std::vector<Point> points_;
  double h_ = 0;
};

}  // namespace twinarm
