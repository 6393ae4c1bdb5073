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

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "collision/detection/collision_world.h"
#include "solver/impulses/event_source.h"
#include "solver/support/checkpointable.h"

namespace twinarm {

enum class ContactResponse { rigid, compliant };

struct ContactSurface {
  double friction = 0.5;   // a pair takes the geometric mean
  double restitution = 0;  // a pair takes the product
  double torsional = 0;    // radius of the patch that resists a turn about the normal [m]
  double rolling = 0;      // arm of the normal force when it rolls [m]
  double stiffness = 1e6;  // compliant: of one contact point; a pair: in_series [N/m]
  double dissipation = 1;  // compliant: c [s/m]
};

struct Compliance {
  double stiffness;    // [N/m]
  double dissipation;  // [s/m]
};
// Two springs between one force: 1/k = 1/ka + 1/kb. Each gives way by its share k/ka, k/kb of the
// depth, and so of its rate: c = ca k/ka + cb k/kb. The softer one says more.
inline Compliance in_series(const Compliance& a, const Compliance& b) {
  const double k = 1 / (1 / a.stiffness + 1 / b.stiffness);
  return {k, a.dissipation * (k / a.stiffness) + b.dissipation * (k / b.stiffness)};
}

// What holds between two geometries.
struct ContactPairLaw {
  double friction, restitution;
  Compliance compliance;
};

struct ContactGeometry {
  std::string name;  // for messages and readings
  int body = 0;      // of the model; 0: fixed in the world
  Pose X_LG;         // in the axes of its link
  Shape shape;
  ContactSurface surface;
  int group = 0;  // CollisionWorld::set_group_filter
};

// One contact point of the last step.
struct ContactPoint {
  Contact contact;  // at the start of the step
  double friction = 0, restitution = 0;
  Compliance compliance{};
  Vector3 impulse_W = Vector3::Zero();   // on b, over the step, impacts included [N s]
  Vector3 force_W = Vector3::Zero();     // on b, without impacts [N]
  Vector3 couple_W = Vector3::Zero();    // on b: torsional and rolling friction [N m]
  Vector3 anchor_W = Vector3::Zero();    // compliant: how far the bristles are bent [m]
  Vector3 velocity_W = Vector3::Zero();  // of b against a, at the end of the step [m/s]
  bool is_held = false, opens = false;   // event_source.h
  Vector3 slip_W = Vector3::Zero();      // of what is held: at the start of the piece [m/s]
};

// Of all points of two geometries, on what they belong to.
struct ContactWork {
  int a, b;
  double normal = 0, friction = 0, impact = 0;  // [J]
  Vector3 impulse_W = Vector3::Zero();          // on b [N s]
  Vector3 moment_W = Vector3::Zero();           // on b, about the world's origin [N m s]
};

// The normal and two directions across it, as columns.
inline Matrix3 contact_axes(const Vector3& n) {
  Matrix3 axes;
  axes.col(0) = n;
  axes.col(1) = n.unitOrthogonal();
  axes.col(2) = n.cross(axes.col(1));
  return axes;
}

class ContactConstraints final : public EventSource, public Rewindable {
 public:
  ContactConstraints(const Model<double>& model, ContactResponse response);

  // Returns its id. Throws InputError for bad numbers.
  int add(const ContactGeometry& geometry);
  // In place of what their surfaces give; the last one counts.
  void set_pair(int a, int b, const ContactPairLaw& law);
  void never(int a, int b) { world_.disable_pair(a, b); }
  CollisionWorld& world() { return world_; }
  const ContactGeometry& geometry(int id) const {
    return geometries_[static_cast<std::size_t>(id)];
  }

  void begin_step(const Kinematics& k, const State<double>& x, double h) noexcept override;
  bool closes(const ConstraintFrame& frame) noexcept override;
  bool look_farther(const Kinematics& k, double h) noexcept override;
  bool wants_separation() const noexcept override;
  void add(const ConstraintFrame& frame, ImpulseProblem& problem) noexcept override;
  void take(const ConstraintFrame& frame, const ImpulseProblem& problem,
            std::size_t first) noexcept override;

  // contact_events.cpp
  void hold(const ConstraintFrame& frame, bool struck) noexcept override;
  void hold_again() noexcept override;
  void look(const ConstraintFrame& frame, Nearest& nearest) const noexcept override;
  void modes(std::vector<char>& modes) const noexcept override;
  std::span<double> works() noexcept override { return flow_works_; }
  void count_works() noexcept override;

  void keep() override { kept_ = {points_, work_}; }
  void go_back() noexcept override;
  void visit_memory(Memory& memory) override;  // contact_memory.cpp

  const std::vector<ContactPoint>& points() const { return points_; }
  // Of all steps so far, ascending by (a, b).
  const std::vector<ContactWork>& work() const { return work_; }

  static constexpr double kSlop = 1e-6;  // penetration that is let be [m]

 private:
  struct PairRule {
    int a, b;
    ContactPairLaw law;
  };
  struct Part {  // a contact's share of the problem
    std::size_t point;
    std::size_t row;  // of its constraint
    int extra;        // constraints for torsional and rolling friction behind it
  };
  struct Kept {
    std::vector<ContactPoint> points;
    std::vector<ContactWork> work;
  };
  double way(std::size_t geometry, const Kinematics& k, double h) const;
  double reach(std::size_t geometry, const Kinematics& k, double h) const;
  ContactPoint start(const Contact& contact) const;
  const ContactPoint* last_of(const Contact& contact) const;
  Vector3 point_on(const Contact& contact, int body) const;
  Vector3 approach(const Contact& contact, const Kinematics& k) const;
  double bounce_speed(std::size_t point, double u, const ConstraintFrame& frame,
                      const ImpulseProblem& problem, const ImpulseConstraint& c) const;
  ContactWork& work_of(const Contact& contact);
  Vector3 moment_of(const Contact& contact, const Vector3& impulse_W) const;
  void take_step(const ConstraintFrame& frame, const ImpulseProblem& problem, const Part& part,
                 const Matrix3& axes);
  void take_flow(ContactPoint& point, const ImpulseConstraint& c, double h, double normal,
                 double friction);
  double may_close(const ConstraintFrame& frame, const ContactPoint& point) const;
  bool takes_part(const ConstraintFrame& frame, std::size_t point) const;
  void add_contact(const ConstraintFrame& frame, std::size_t point, ImpulseProblem& problem);
  void add_friction_couples(const ConstraintFrame& frame, std::size_t point, const Matrix3& axes,
                            ImpulseProblem& problem);
  void set_compliance(std::size_t point, double h, const Matrix3& axes, ImpulseConstraint& c) const;

  const Model<double>* model_;
  ContactResponse response_;
  bool has_drives_ = false;
  bool locates_ = false;            // hold() was called: steps locate their events
  std::vector<char> is_immovable_;  // by body: neither forces nor impulses move it
  CollisionWorld world_;
  std::vector<ContactGeometry> geometries_;
  std::vector<double> radius_;  // by geometry: of a ball about its link's origin [m]
  std::vector<PairRule> rules_;
  std::vector<Pose> X_WG_;
  std::vector<double> reach_;
  std::vector<Contact> contacts_;
  std::vector<ContactPoint> points_, last_, held_;  // sorted by (a, b, feature)
  Kept kept_;
  std::vector<ContactWork> work_;
  std::vector<std::pair<int, int>> held_pairs_;  // ascending
  // Of each: works of normal force and friction, impulse, moment.
  static constexpr std::size_t kFlowNumbers = 8;
  std::vector<double> flow_works_;
  std::vector<char> modes_;  // of the held, after a flow
  std::vector<double> gap_after_;
  std::vector<char> closing_;
  std::vector<Part> parts_;
};

}  // namespace twinarm
