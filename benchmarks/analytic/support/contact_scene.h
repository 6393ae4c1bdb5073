// Free bodies, fixed ones and turning ones under rigid contact: what the contact cases run.
//
// Steps are 1 ms where nothing else is said. Event times shall be met within one step, velocities
// to 1e-3 of themselves; a place is measured by the time that its error is worth, at the speed
// there.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/analytic/support/analytic_case.h"
#include "collision/contact/contact_constraints.h"
#include "solver/dynamics/model_builder.h"
#include "solver/stepping/simulation.h"

namespace twinarm {

enum class Steps { fixed, located };
constexpr double kStep = 1e-3;              // of the cases that name no other [s]
inline constexpr double kBallRadius = 0.1;  // of the balls of several cases [m]

// A body on the incline x: gravity is turned instead of the floor, which stays z = 0. [rad]
inline Vector3 tilted_gravity(double angle) {
  return kGravity * Vector3(std::sin(angle), 0, -std::cos(angle));
}
inline Matrix3 turn_about(const Vector3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}
inline Matrix3 axis_along_y() {  // of a cylinder that rolls along x
  return turn_about(Vector3::UnitX(), std::numbers::pi / 2);
}
inline ContactSurface surface(double friction, double restitution = 0) {
  ContactSurface s;
  s.friction = friction, s.restitution = restitution;
  return s;
}

class ContactScene;

// Of one scene; evenly spaced steps, thinned to some hundreds.
struct ContactRun {
  std::vector<double> t, energy;          // [s], kinetic and potential [J]
  std::vector<std::vector<double>> seen;  // by reading, then by t
  double tried = 0;                       // in a search for a limit: the value, and its outcome
  bool holds = false;
};

// What a page sees of the scenes of a contact case while it runs: readings and energy over time, or
// the same runs with another step. Without a recorder nothing is noted, and a case is what it is.
// Ends the experiment by an Enough that comes out of start(), step() or threshold(), once all that
// was asked for is there.
class ContactRecorder {
 public:
  struct Enough {};
  std::function<std::vector<double>(const ContactScene&)> look{};  // null: nothing is noted
  std::size_t count = 1;    // of the runs to note; in a search always two, one of each outcome
  std::size_t every = 1;    // the scenes of a case of which one is noted
  double until = HUGE_VAL;  // [s]
  bool search = false;
  double step_scale = 1;  // all steps are longer by it
  std::vector<ContactRun> runs{};

  void begin(const ContactScene& scene);
  void note(const ContactScene& scene, double energy);
  void outcome(double tried, bool holds);

 private:
  void add(const ContactScene& scene, double energy);
  std::size_t begun_ = 0, steps_ = 0, stride_ = 1;
  bool active_ = false;
};

// That of the scenes that this thread makes; null: none.
inline thread_local ContactRecorder* contact_recorder = nullptr;

// Add all bodies, then start(), then step(). Bodies are numbered from 1, their link frames stand at
// their centres of mass.
class ContactScene {
 public:
  struct Body {
    Shape shape;
    ContactSurface surface{};
    double mass = 1;
    Vector3 p = Vector3::Zero();  // of the centre of mass [m]
    Vector3 v = Vector3::Zero();  // of it [m/s]
    Vector3 w = Vector3::Zero();  // world axes [rad/s]
    Matrix3 R = Matrix3::Identity();
    Matrix3 inertia = Matrix3::Zero();   // zero: that of the uniform solid [kg m^2]
    Vector3 shape_at = Vector3::Zero();  // the shape's centre, in link axes [m]
  };
  explicit ContactScene(const Vector3& gravity = {0, 0, -kGravity}) {
    builder_.set_gravity(gravity);
  }
  // Gravity times `off`, for mistakes.
  explicit ContactScene(double off) : ContactScene(Vector3(0, 0, -kGravity * off)) {}
  ContactScene(const ContactScene&) = delete;
  ContactScene& operator=(const ContactScene&) = delete;

  int add(const Body& body);
  void add_fixed(const Shape& shape, const ContactSurface& surface, const Pose& X_WG = {});
  void add_floor(const ContactSurface& surface) { add_fixed(HalfSpace{}, surface); }
  void add_turning(const Shape& shape, const ContactSurface& surface, const Pose& X_WG,
                   double rate);
  void start();
  // After start(): a constant force at the centre of mass of a free body, which no energy counts.
  // World axes.
  void push(int body, const Vector3& force);
  // From now on steps of any length, whose events are located in time.
  void locate_events() { simulation_->locate_events(); }

  bool step(double h);  // false where it was not finite or not solved
  void run(double duration, double h);
  double t() const { return simulation_->state().t; }
  Vector3 p(int body) const { return simulation_->kinematics().X_WL[index(body)].p; }
  Matrix3 R(int body) const { return simulation_->kinematics().X_WL[index(body)].R; }
  Vector3 v(int body) const { return simulation_->kinematics().v_WLo[index(body)]; }
  Vector3 w(int body) const { return simulation_->kinematics().w_WL[index(body)]; }
  Vector3 force(int body) const;  // of all contacts, on the body, in the last step [N]
  double energy() const;          // [J]
  // Over all steps: max |E - E0| over the largest kinetic energy, and the most that E rose above
  // the lowest value before it.
  double drift() const { return strayed_ / max_kinetic_; }
  double rise() const { return rise_ / max_kinetic_; }
  bool ok() const { return ok_; }  // all steps were

  Simulation& simulation() { return *simulation_; }
  const Model<double>& model() const { return model_; }
  const ContactConstraints& contacts() const { return *contacts_; }

 private:
  static std::size_t index(int body) { return static_cast<std::size_t>(body); }
  void watch();

  struct Fixed {
    Shape shape;
    ContactSurface surface;
    Pose X_WG;
    int body;  // 0, or the turning one
  };
  struct Turning {
    int body;
    Pose X_WG;
    double rate;
  };
  ModelBuilder builder_;
  std::vector<std::pair<int, Body>> bodies_;
  std::vector<Fixed> fixed_;
  std::vector<Turning> turning_;
  int count_ = 0;
  Model<double> model_;
  std::unique_ptr<ContactConstraints> contacts_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<std::unique_ptr<ForceSource>> pushes_;
  double start_energy_ = 0, lowest_ = 0, strayed_ = 0, rise_ = 0, max_kinetic_ = 0;
  bool ok_ = true;
};

// The value between `low`, where the outcome is false, and `high`, where it is true, to `within`.
template <class Outcome>
double threshold(double low, double high, double within, Outcome&& outcome) {
  while (high - low > within) {
    const double middle = 0.5 * (low + high);
    const bool holds = outcome(middle);
    if (contact_recorder) contact_recorder->outcome(middle, holds);
    (holds ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

// A case whose error falls with the step: its error at h, and the order from h to h / 4 where the
// error is more than rounding.
template <class Error>
CaseResult with_order(Error&& error, double h) {
  constexpr double kRounding = 1e-9;
  CaseResult result{error(h)};
  const double fine = error(h / 4);
  if (fine > kRounding) result.order = std::log(result.error / fine) / std::log(4);
  return result;
}

inline double relative(double value, double reference) {
  return std::abs(value / reference - 1);
}

// What a page draws of a contact case: which coordinate of which body, and what is known of it in
// closed form. Its scenes are made and stepped by the case itself, while a recorder looks on
// (contact_scene.h).
struct ContactCasePlot {
  std::vector<std::string> readings;  // with unit: "height [m]"
  std::vector<double> (*read)(const ContactScene&);
  // Of curve `k` at a time; not a number where it is not known. Curves are readings, or runs.
  double (*exact)(std::size_t k, double t) = nullptr;
  std::vector<std::string> runs{};  // of one reading: a curve each. Empty: the first run
  std::size_t every = 1;            // of so many scenes one is such a run
  double until = HUGE_VAL;          // [s]
  double known_at = NAN;            // the only time at which exact() is known [s]
  bool from_start = false;          // readings count from where they begin
  // What is tried to find a limit, of which a run on either side is drawn; null: no search.
  const char* search = nullptr;
  double step = kStep;             // of the case [s]
  const char* no_steps = nullptr;  // why no error is drawn against the step; null: it is
  const char* about_steps = "";    // what is to be said of that error, where it has no order
};

// What several cases are looked at by, and why some have no error against the step.
namespace contact_looks {

using Values = std::vector<double>;
using Scene = const ContactScene&;

inline constexpr const char* kLocated =
    "Events are located in time: what is left of the error does not come from the step.";
inline constexpr const char* kPartOfStep =
    "The end of sliding is met by the next step: the error is some part of a step.";
inline constexpr const char* kSearch =
    "The limit is found by bisection; drawn are its first runs on either side.";
inline constexpr const char* kCounted =
    "Faults are counted: there is no error to draw against the step.";
inline constexpr const char* kRounding =
    "What is kept is kept at every step: only rounding and the tolerance of the solver are left.";
inline constexpr const char* kResting =
    "Nothing moves: the tolerance of the solver is left, at any step.";

// Body by body, from 1 on; axes 0 to 2.
template <int body, int axis>
Values place(Scene s) {
  return {s.p(body)[axis]};
}
template <int body, int axis>
Values velocity(Scene s) {
  return {s.v(body)[axis]};
}
template <int... bodies>
Values velocities_x(Scene s) {
  return {s.v(bodies).x()...};
}
template <int radius_mm10>
Values speed_and_rim(Scene s) {
  return {s.v(1).x(), 1e-4 * radius_mm10 * s.w(1).y()};
}
inline double zero(std::size_t, double) {
  return 0;
}

// The same without an error against the step, and why; or as runs on either side of a limit.
inline ContactCasePlot without_steps(ContactCasePlot look, const char* why) {
  look.no_steps = why;
  return look;
}
inline ContactCasePlot searched(ContactCasePlot look, const char* what) {
  look.search = what;
  return without_steps(look, kSearch);
}
inline ContactCasePlot of_runs(ContactCasePlot look, std::vector<std::string> runs) {
  look.runs = std::move(runs);
  return look;
}

}  // namespace contact_looks

// A case with its mistake: the experiment multiplies one thing in it by `off`, which is 1 in the
// case; in the mistake it is some thousandths more or less, and the case must fail.
template <CaseResult (*experiment)(double off), int thousandths>
AnalyticCase contact_case(const char* name, double tolerance, ContactCasePlot look = {}) {
  AnalyticCase c(name, tolerance,
                 [](bool mistaken) { return experiment(mistaken ? 1 + 1e-3 * thousandths : 1); });
  if (look.read) c.look = std::make_shared<const ContactCasePlot>(std::move(look));
  return c;
}

}  // namespace twinarm
