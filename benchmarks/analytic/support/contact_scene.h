// Scene of the contact cases: free, fixed and rotating bodies under rigid or compliant contact.
//
// Steps are 1 ms unless stated otherwise. Tolerances: one step for event times, 1e-3 relative for
// velocities; an error of position is divided by the speed there and so becomes a time.
#pragma once

#include <initializer_list>

#include "benchmarks/analytic/support/analytic_case.h"
#include "collision/contact/contact_constraints.h"
#include "solver/dynamics/model_builder.h"
#include "solver/stepping/simulation.h"

namespace twinarm {

enum class Steps { fixed, located };
constexpr double kStep = 1e-3;              // default step [s]
inline constexpr double kBallRadius = 0.1;  // of the balls of several cases [m]

// Of an incline [rad] with x downhill: gravity is rotated, the floor stays z = 0.
inline Vector3 tilted_gravity(double angle) {
  return kGravity * Vector3(std::sin(angle), 0, -std::cos(angle));
}
inline Matrix3 rotation_about(const Vector3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}
inline Matrix3 axis_along_y() {  // attitude of a cylinder that rolls along x
  return rotation_about(Vector3::UnitX(), std::numbers::pi / 2);
}
inline ContactSurface surface(double friction, double restitution = 0) {
  ContactSurface s;
  s.friction = friction, s.restitution = restitution;
  return s;
}

class ContactScene;

// Readings and energy of one scene at evenly spaced times, at most 1,200.
struct ContactRun {
  std::vector<double> t, energy;            // [s], kinetic and potential [J]
  std::vector<std::vector<double>> values;  // by reading, then by t
  double parameter = 0;                     // in a bisection: its value, and the outcome
  bool outcome = false;
};

// Records the scenes of a contact case while it runs, or runs it with another step. Throws Complete
// out of start(), step() or threshold() as soon as all requested runs are recorded.
class ContactRecorder {
 public:
  struct Complete {};
  std::function<std::vector<double>(const ContactScene&)> read{};  // null: nothing is recorded
  std::size_t count = 1;    // runs to record; in a bisection two, one of each outcome
  std::size_t every = 1;    // records every nth scene
  double until = HUGE_VAL;  // [s]
  bool bisects = false;
  double step_scale = 1;  // factor of all steps
  std::vector<ContactRun> runs{};

  void begin(const ContactScene& scene);
  void record(const ContactScene& scene, double energy);
  void end(double parameter, bool outcome);

 private:
  void add(const ContactScene& scene, double energy);
  bool is_complete() const { return !bisects && runs.size() == count; }
  std::size_t begun_ = 0, steps_ = 0, stride_ = 1;
  bool active_ = false;
};

// Recorder of the scenes that this thread makes; null: none.
inline thread_local ContactRecorder* contact_recorder = nullptr;

// Add all bodies, then start(), then step(). Bodies are numbered from 1; a link frame has its
// origin at the centre of mass.
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
  explicit ContactScene(double gravity_scale)
      : ContactScene(Vector3(0, 0, -kGravity * gravity_scale)) {}
  ContactScene(const ContactScene&) = delete;
  ContactScene& operator=(const ContactScene&) = delete;

  int add(const Body& body);
  void add_fixed(const Shape& shape, const ContactSurface& surface, const Pose& X_WG = {}) {
    fixed_.push_back({"fixed", 0, X_WG, shape, surface});
  }
  void add_floor(const ContactSurface& surface) { add_fixed(HalfSpace{}, surface); }
  void add_rotating(const Shape& shape, const ContactSurface& surface, const Pose& X_WG,
                    double rate);  // about z of its frame [rad/s]
  void start();
  int start(const Body& body);           // add() of the last body, and start()
  int start_on_floor(const Body& body);  // with a floor of the body's surface
  // After start(): a further force. energy() does not include its work.
  void apply(ForceLaw::Law law);
  void apply_force(int body, const Vector3& force);   // at a free body's centre of mass, world axes
  ContactResponse response = ContactResponse::rigid;  // to be set before start()
  void locate_events() { simulation_->locate_events(); }

  bool step(double h);  // false: not finite or not solved
  void run(double duration, double h);
  // Maximum of f(), at least 0, after each step of h to the time `end`.
  template <class F>
  double max_until(double end, double h, F&& f) {
    double max = 0;
    for (; t() < end; max = std::max(max, f())) step(h);
    return max;
  }
  double t() const { return simulation_->state().t; }
  Vector3 p(int body) const { return simulation_->kinematics().X_WL[index(body)].p; }
  Matrix3 R(int body) const { return simulation_->kinematics().X_WL[index(body)].R; }
  Vector3 v(int body) const { return simulation_->kinematics().v_WLo[index(body)]; }
  Vector3 w(int body) const { return simulation_->kinematics().w_WL[index(body)]; }
  Vector3 force(int body) const;  // sum of the contact forces on the body in the last step [N]
  double energy() const;          // [J]
  // Over all steps, relative to the largest kinetic energy: max |E - E0|, and the largest rise of E
  // above its earlier minimum.
  double drift() const { return energy_error_ / max_kinetic_; }
  double rise() const { return rise_ / max_kinetic_; }
  bool ok() const { return ok_; }  // so far

  Simulation& simulation() { return *simulation_; }
  const Model<double>& model() const { return model_; }
  const ContactConstraints& contacts() const { return *contacts_; }

 private:
  static std::size_t index(int body) { return static_cast<std::size_t>(body); }
  void update_energy();

  ModelBuilder builder_;
  std::vector<std::pair<int, Body>> bodies_;
  std::vector<ContactGeometry> fixed_;  // on the world and on rotating bodies
  std::vector<std::pair<int, MotionFunction>> rotating_;
  int count_ = 0;
  Model<double> model_;
  std::unique_ptr<ContactConstraints> contacts_;
  std::unique_ptr<Simulation> simulation_;
  std::vector<std::unique_ptr<ForceLaw>> forces_;
  double start_energy_ = 0, min_energy_ = 0, energy_error_ = 0, rise_ = 0, max_kinetic_ = 0;
  bool ok_ = true;
};

// Bisects for the parameter at which the outcome changes from false (at `low`) to true (at `high`),
// to an accuracy of `width`.
template <class Outcome>
double threshold(double low, double high, double width, Outcome&& outcome) {
  while (high - low > width) {
    const double middle = 0.5 * (low + high);
    const bool is_above = outcome(middle);
    if (contact_recorder) contact_recorder->end(middle, is_above);
    (is_above ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

// Maximum of f over the values, at least 0.
template <class Values = std::initializer_list<double>, class F>
double max_over(const Values& values, F&& f) {
  double max = 0;
  for (const auto& value : values) max = std::max(max, f(value));
  return max;
}

// Error at h, and the order of convergence from h to h / 4 unless the error there is rounding.
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

// Plot of a contact case: which readings are drawn, and their closed form. The scenes are those of
// the case itself, observed by a ContactRecorder.
struct ContactCasePlot {
  std::vector<std::string> readings{};  // with unit: "height [m]"
  std::vector<double> (*read)(const ContactScene&) = nullptr;
  // Closed form of curve k at time t; NAN where it is unknown. Curves are readings, or runs.
  double (*exact)(std::size_t k, double t) = nullptr;
  std::vector<std::string> runs{};  // names of several runs of one reading; empty: the first run
  std::size_t every = 1;            // every nth scene is such a run
  double until = HUGE_VAL;          // [s]
  double known_at = NAN;            // the only time at which exact() is known [s]
  bool from_start = false;          // readings are differences to their start
  // Name of a parameter whose limit is bisected; a run on either side of it is drawn. Null: none.
  const char* searched = nullptr;
  double step = kStep;                   // of the case [s]
  const char* no_convergence = nullptr;  // why no error is drawn against the step; null: it is
  const char* convergence_note = "";     // remark on that error, where it has no order

  // Copies with one member changed.
  template <class T>
  ContactCasePlot with(T ContactCasePlot::*member, std::type_identity_t<T> value) const {
    ContactCasePlot plot = *this;
    plot.*member = std::move(value);
    return plot;
  }
  ContactCasePlot without_convergence(const char* why) const {
    return with(&ContactCasePlot::no_convergence, why);
  }
  ContactCasePlot of_runs(std::vector<std::string> names) const {
    return with(&ContactCasePlot::runs, std::move(names));
  }
  ContactCasePlot searching(const char* parameter) const {
    return with(&ContactCasePlot::searched, parameter)
        .without_convergence(
            "The limit is found by bisection; its first runs on either side are drawn.");
  }
};

// Readings and remarks that several cases share.
namespace contact_plots {

using Plot = ContactCasePlot;
using Values = std::vector<double>;
using Scene = const ContactScene&;

inline constexpr const char* kLocated =
    "Events are located in time: the remaining error does not depend on the step.";
inline constexpr const char* kPartOfStep =
    "The end of sliding is found at the end of a step: the error is a fraction of a step.";
inline constexpr const char* kCounted =
    "Violations are counted: there is no error to draw against the step.";
inline constexpr const char* kRounding =
    "The quantity is conserved in every step: the error is rounding and the tolerance of the "
    "solver.";
inline constexpr const char* kResting =
    "Nothing moves: at any step the error is the tolerance of the solver.";

// Bodies are numbered from 1, axes from 0.
template <int body, int axis>
Values place(Scene s) {
  return {s.p(body)[axis]};
}
template <int body, int axis>
Values velocity(Scene s) {
  return {s.v(body)[axis]};
}
template <int axis>
Values spin(Scene s) {
  return {s.w(1)[axis]};
}
template <int... bodies>
Values velocities_x(Scene s) {
  return {s.v(bodies).x()...};
}
template <int radius_mm10>
Values speed_and_rim(Scene s) {
  return {s.v(1).x(), 1e-4 * radius_mm10 * s.w(1).y()};
}
inline Values horizontal_distance(Scene s) {
  return {std::hypot(s.p(1).x(), s.p(1).y())};
}
inline Values slip(Scene s) {  // of a ball of kBallRadius
  return {s.v(1).x() - 0.1 * s.w(1).y()};
}
inline double zero(std::size_t, double) {
  return 0;
}

}  // namespace contact_plots

// A case with its mutant: the experiment multiplies one of its parameters by `scale`, which is 1 in
// the case and 1 + thousandths / 1000 in the mutant, which must fail.
template <CaseResult (*experiment)(double scale), int thousandths>
AnalyticCase contact_case(const char* name, double tolerance, ContactCasePlot plot = {}) {
  AnalyticCase c(name, tolerance,
                 [](bool is_mutant) { return experiment(is_mutant ? 1 + 1e-3 * thousandths : 1); });
  if (plot.read) c.plot = std::make_shared<const ContactCasePlot>(std::move(plot));
  return c;
}

}  // namespace twinarm
