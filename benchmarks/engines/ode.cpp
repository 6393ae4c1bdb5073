// ODE, in double.
//
// header: ode/ode.h
// libraries: ode
//
// Every body has six coordinates, joints are constraints, friction cones are pyramids. Both of its
// solvers: `step` (Dantzig) and `quick` (successive over-relaxation, 20 iterations); otherwise
// defaults.
#include <ode/ode.h>

#include <Eigen/Geometry>
#include <cmath>

#include "benchmarks/engines/engine.h"

namespace twinarm::bench {
namespace {

struct Place {  // pose and velocity of a body in the world
  Eigen::Quaterniond R{1, 0, 0, 0};
  Vector3d p{0, 0, 0}, v{0, 0, 0}, w{0, 0, 0};  // of its origin
};
// Of a body with these joint coordinates and this parent.
Place place_of(const Body& b, const Place& parent, const double* q, const double* v) {
  const Eigen::Quaterniond at_zero = parent.R * Eigen::Quaterniond(b.rotation);
  const Vector3d arm = parent.R * b.position;
  Place place{at_zero, parent.p + arm, parent.v + parent.w.cross(arm), parent.w};
  if (b.joint == Joint::revolute) {
    place.R = at_zero * Eigen::AngleAxisd(q[0], axis_of(b));
    place.w += place.R * (v[0] * axis_of(b));
  } else if (b.joint == Joint::spherical) {
    place.R = at_zero * quaternion(q);
    place.w += place.R * Vector3d(v);
  } else {
    place.p += at_zero * Vector3d(q), place.R = at_zero * quaternion(q + 3);
    place.v += at_zero * Vector3d(v + 3), place.w += place.R * Vector3d(v);
  }
  return place;
}
// The inverse; hinge angles within half a turn.
void joint_of(const Body& b, const Place& parent, const Place& body, double* q, double* v) {
  const Eigen::Quaterniond at_zero = parent.R * Eigen::Quaterniond(b.rotation);
  const Eigen::Quaterniond turn = at_zero.conjugate() * body.R;
  const Vector3d w_B = body.R.conjugate() * (body.w - parent.w);
  if (b.joint == Joint::revolute) {
    q[0] = std::remainder(2 * std::atan2(turn.vec().dot(axis_of(b)), turn.w()), 2 * M_PI);
    v[0] = w_B.dot(axis_of(b));
    return;
  }
  if (b.joint == Joint::free) {
    Vector3d::Map(q) = body.p, Vector3d::Map(v + 3) = body.v;
    q += 3;
  }
  write_quaternion(turn, q);
  Vector3d::Map(v) = w_B;
}

class Ode final : public FixedStepEngine {
 public:
  Ode() { dInitODE(); }
  ~Ode() override { clear(); }
  Ode(const Ode&) = delete;
  Ode& operator=(const Ode&) = delete;
  std::string name() const override { return "ode"; }
  std::vector<Scheme> schemes(const Scene&) const override { return {{"step"}, {"quick"}}; }
  std::vector<Scheme> contact_schemes(const Scene& scene) const override {
    return std::vector<Scheme>(scene.control ? 0 : 1, {"quick"});  // control is not applied
  }

  void load(const Scene& scene, const Scheme& scheme, double h) override {
    begin(scene, h);
    clear();
    quick_ = scheme.name == "quick";
    world_ = dWorldCreate();
    space_ = dHashSpaceCreate(nullptr);
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, scene.gravity[0], scene.gravity[1], scene.gravity[2]);
    if (scene.uncorrected) dWorldSetERP(world_, 0), dWorldSetCFM(world_, 0);
    set_joints();
    if (scene.floor) dCreatePlane(space_, 0, 0, 1, 0);
    for (const auto& [centre, half] : scene.fixed_boxes)
      dGeomSetPosition(dCreateBox(space_, 2 * half[0], 2 * half[1], 2 * half[2]), centre[0],
                       centre[1], centre[2]);
  }
  void step() override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Vector3d& F = scene_.bodies[i].push;
      if (!F.isZero(0)) dBodyAddForce(bodies_[i], F[0], F[1], F[2]);
    }
    if (scene_.has_contacts()) dSpaceCollide(space_, this, &Ode::near);
    if (quick_)
      dWorldQuickStep(world_, h_);
    else
      dWorldStep(world_, h_);
    dJointGroupEmpty(contacts_);
  }

 private:
  // ODE bodies are positioned at their centre of mass.
  void set_joint(std::size_t i, const double* q, const double* v) override {
    const Body& b = scene_.bodies[i];
    const Place place =
        places_.emplace_back(place_of(b, b.parent < 0 ? Place{} : places_[index(b.parent)], q, v));
    const dBodyID body = bodies_.emplace_back(dBodyCreate(world_));
    dMass mass;
    const auto& [xx, yy, zz, xy, xz, yz] = b.inertia;
    dMassSetParameters(&mass, b.mass, 0, 0, 0, xx, yy, zz, xy, xz, yz);
    dBodySetMass(body, &mass);
    const Vector3d c = place.R * b.com, p_C = place.p + c;
    const Vector3d v_C = place.v + place.w.cross(c);
    const dQuaternion turn = {place.R.w(), place.R.x(), place.R.y(), place.R.z()};
    dBodySetPosition(body, p_C.x(), p_C.y(), p_C.z());
    dBodySetQuaternion(body, turn);
    dBodySetLinearVel(body, v_C.x(), v_C.y(), v_C.z());
    dBodySetAngularVel(body, place.w.x(), place.w.y(), place.w.z());
    if (b.form != Form::none) {
      const dGeomID shape = b.form == Form::sphere
                                ? dCreateSphere(space_, b.half[0])
                                : dCreateBox(space_, 2 * b.half[0], 2 * b.half[1], 2 * b.half[2]);
      dGeomSetBody(shape, body);
    }
    const dBodyID parent = b.parent < 0 ? nullptr : bodies_[index(b.parent)];
    if (b.joint == Joint::revolute) {
      const dJointID hinge = dJointCreateHinge(world_, nullptr);
      dJointAttach(hinge, body, parent);
      dJointSetHingeAnchor(hinge, place.p.x(), place.p.y(), place.p.z());
      const Vector3d axis = place.R * axis_of(b);
      dJointSetHingeAxis(hinge, axis.x(), axis.y(), axis.z());
    } else if (b.joint == Joint::spherical) {
      const dJointID ball = dJointCreateBall(world_, nullptr);
      dJointAttach(ball, body, parent);
      dJointSetBallAnchor(ball, place.p.x(), place.p.y(), place.p.z());
    }
  }
  Place present_place(int i) const {  // of a body; of the world for -1
    if (i < 0) return {};
    const dBodyID body = bodies_[index(i)];
    Place place{quaternion(dBodyGetQuaternion(body)), Vector3d(dBodyGetPosition(body)),
                Vector3d(dBodyGetLinearVel(body)), Vector3d(dBodyGetAngularVel(body))};
    const Vector3d com = place.R * scene_.bodies[index(i)].com;
    place.p -= com, place.v -= place.w.cross(com);
    return place;
  }
  void read_joint(std::size_t i, double* q, double* v) override {
    const Body& b = scene_.bodies[i];
    joint_of(b, present_place(b.parent), present_place(static_cast<int>(i)), q, v);
  }
  static void near(void* self, dGeomID a, dGeomID b) {
    Ode& ode = *static_cast<Ode*>(self);
    if (dGeomGetBody(a) == nullptr && dGeomGetBody(b) == nullptr) return;  // both fixed
    constexpr int kMax = 8;
    dContact contacts[kMax] = {};
    const int count = dCollide(a, b, kMax, &contacts[0].geom, sizeof(dContact));
    const bool floor = dGeomGetClass(a) == dPlaneClass || dGeomGetClass(b) == dPlaneClass;
    for (int i = 0; i < count; ++i) {
      dSurfaceParameters& surface = contacts[i].surface;
      surface.mode = dContactApprox1 | (ode.scene_.restitution > 0 ? dContactBounce : 0);
      surface.mu = floor ? ode.scene_.floor_friction : ode.scene_.friction;
      surface.bounce = ode.scene_.restitution;
      surface.bounce_vel = 1e-3;
      dJointAttach(dJointCreateContact(ode.world_, ode.contacts_, &contacts[i]), dGeomGetBody(a),
                   dGeomGetBody(b));
    }
  }
  void clear() {
    bodies_.clear(), places_.clear();
    if (world_ == nullptr) return;
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
    world_ = nullptr;
  }

  bool quick_ = false;
  dWorldID world_ = nullptr;
  dSpaceID space_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  std::vector<dBodyID> bodies_;
  std::vector<Place> places_;  // at the start
};

}  // namespace

EngineKind ode_engine() {
  return {"ode", 5, one_engine<Ode>};
}

}  // namespace twinarm::bench
