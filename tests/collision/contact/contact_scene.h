// A scene of free bodies and obstacles.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "collision/contact/contact_constraints.h"
#include "collision/shapes/shape.h"
#include "solver/dynamics/energy_momentum.h"
#include "solver/dynamics/model_builder.h"
#include "solver/stepping/simulation.h"

namespace twinarm::testing {

inline ContactSurface rough_surface(double friction, double restitution) {
  return {.friction = friction, .restitution = restitution};
}

class ContactScene {
 public:
  explicit ContactScene(ContactResponse response = ContactResponse::rigid) : response_(response) {}
  void set_gravity(const Vector3& g) { builder_.set_gravity(g); }

  struct Start {
    Vector3 p = Vector3::Zero(), v = Vector3::Zero(), w = Vector3::Zero();
    Matrix3 R = Matrix3::Identity();
  };
  // A uniform solid of that mass; returns its body, 1, 2 ...
  int body(const Shape& shape, double mass, const ContactSurface& surface, const Start& start) {
    const MassProperties solid = with_mass(mass_properties(shape, 1000), mass);
    const int id = static_cast<int>(starts_.size()) + 1;
    const std::string name = "body" + std::to_string(id);
    builder_.add_body(name, 0, name, JointType::free, {}, Vector3::UnitZ(),
                      {solid.mass, solid.com, solid.inertia});
    starts_.push_back(start);
    pieces_.push_back({name, id, {}, shape, surface, 0});
    return id;
  }
  void obstacle(const Shape& shape, const ContactSurface& surface, const Pose& X = {}) {
    pieces_.push_back({"obstacle", 0, X, shape, surface, 0});
  }
  void floor(const ContactSurface& surface) { obstacle(HalfSpace{}, surface); }

  // A half-space with prescribed motion. Add it after all bodies.
  void table(const MotionFunction& motion, const ContactSurface& surface) {
    table_ =
        builder_.add_body("table", 0, "table", JointType::prescribed, {}, Vector3::UnitZ(), {});
    pieces_.push_back({"table", table_, {}, HalfSpace{}, surface, 0});
    table_motion_ = motion;
  }

  // Call after adding all bodies.
  Simulation& begin(const SimulationOptions& options = {}) {
    model_ = std::make_unique<Model<double>>(builder_.build());
    State<double> x(*model_);
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      const Start& s = starts_[i];
      const Eigen::Quaterniond turn(s.R);
      double *q = x.q.data() + model_->iq[i + 1], *qd = x.qd.data() + model_->iv[i + 1];
      const Vector3 w = s.R.transpose() * s.w;
      for (int k = 0; k < 3; ++k)
        q[k] = s.p[k], q[4 + k] = turn.vec()[k], qd[k] = w[k], qd[3 + k] = s.v[k];
      q[3] = turn.w();
    }
    simulation_ = std::make_unique<Simulation>(*model_, x, options);
    if (table_ > 0) simulation_->prescribe(table_, table_motion_);
    contacts_ = std::make_unique<ContactConstraints>(*model_, response_);
    if (by_fcl) contacts_->bodies().world().use_fcl();
    for (const ContactGeometry& piece : pieces_) contacts_->bodies().add(piece);
    simulation_->add(*contacts_);
    return *simulation_;
  }
  void run(double h, int steps) {
    for (int n = 0; n < steps; ++n) simulation_->step(h);
  }

  Simulation& simulation() { return *simulation_; }
  const ContactConstraints& contacts() const { return *contacts_; }
  Vector3 position(int body) const {
    return simulation_->kinematics().X_WL[static_cast<std::size_t>(body)].p;
  }
  Vector3 velocity(int body) const {
    return simulation_->kinematics().v_WLo[static_cast<std::size_t>(body)];
  }
  double energy() const {
    return kinetic_energy(*model_, simulation_->state()) +
           potential_energy(*model_, simulation_->state());
  }
  const ConstraintReport& report() const { return simulation_->constraints().report(); }

  bool by_fcl = false;  // set before begin()

 private:
  ContactResponse response_;
  ModelBuilder builder_;
  int table_ = 0;  // body, 0: none
  MotionFunction table_motion_;
  std::vector<Start> starts_;
  std::vector<ContactGeometry> pieces_;
  std::unique_ptr<Model<double>> model_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<ContactConstraints> contacts_;
};

}  // namespace twinarm::testing
