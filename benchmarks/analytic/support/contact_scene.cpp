#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

double scaled_step(double h) {
  return contact_recorder ? contact_recorder->step_scale * h : h;
}

}  // namespace

int ContactScene::add(const Body& body) {
  BodyInertia inertia;
  inertia.mass = body.mass;
  inertia.inertia = body.inertia;
  if (body.inertia.isZero())
    inertia.inertia = with_mass(mass_properties(body.shape, 1000), body.mass).inertia;
  const std::string name = std::to_string(++count_);
  builder_.add_body(name, 0, "joint " + name, JointType::free, {}, Vector3::UnitZ(), inertia);
  bodies_.emplace_back(count_, body);
  return count_;
}

void ContactScene::add_rotating(const Shape& shape, const ContactSurface& surface, const Pose& X_WG,
                                double rate) {
  const std::string name = std::to_string(++count_);
  builder_.add_body(name, 0, "joint " + name, JointType::prescribed, {}, Vector3::UnitZ(), {});
  fixed_.push_back({"fixed", count_, {}, shape, surface});
  rotating_.emplace_back(count_, [X_WG, rate](double t) {
    PrescribedMotion motion;
    motion.X_JL = {X_WG.R * rotation_about(Vector3::UnitZ(), rate * t), X_WG.p};
    motion.angular_velocity = rate * X_WG.R.col(2);
    return motion;
  });
}

void ContactScene::start() {
  model_ = builder_.build();
  State<double> x(model_);
  contacts_ = std::make_unique<ContactConstraints>(model_, response);
  for (const ContactGeometry& geometry : fixed_) contacts_->bodies().add(geometry);
  for (const auto& [number, body] : bodies_) {
    double* q = x.q.data() + model_.iq[index(number)];
    double* qd = x.qd.data() + model_.iv[index(number)];
    const Eigen::Quaterniond rotation(body.R);
    const Vector3 w_L = body.R.transpose() * body.w;
    for (int k = 0; k < 3; ++k) q[k] = body.p[k], qd[k] = w_L[k], qd[3 + k] = body.v[k];
    q[3] = rotation.w(), q[4] = rotation.x(), q[5] = rotation.y(), q[6] = rotation.z();
    contacts_->bodies().add(
        {"body", number, {Matrix3::Identity(), body.shape_at}, body.shape, body.surface});
  }
  simulation_ = std::make_unique<Simulation>(model_, x);
  for (const auto& [body, motion] : rotating_) simulation_->prescribe(body, motion);
  simulation_->add(*contacts_);
  start_energy_ = min_energy_ = energy();
  max_kinetic_ = kinetic_energy(model_, simulation_->state());
  if (contact_recorder) contact_recorder->begin(*this);
}

int ContactScene::start(const Body& body) {
  const int number = add(body);
  start();
  return number;
}

int ContactScene::start_on_floor(const Body& body) {
  add_floor(body.surface);
  return start(body);
}

void ContactScene::apply(ForceLaw::Law law) {
  forces_.push_back(std::make_unique<ForceLaw>(std::move(law)));
  simulation_->add(*forces_.back());
}

void ContactScene::apply_force(int body, const Vector3& force) {
  apply(
      [dof = model_.iv[index(body)] + 3, force](const auto&, const auto&, Forces<double>& forces) {
        for (std::size_t i = 0; i < 3; ++i)
          forces.tau[dof + i] += force[static_cast<Eigen::Index>(i)];
      });
}

double ContactScene::energy() const {
  return kinetic_energy(model_, simulation_->state()) +
         potential_energy(model_, simulation_->state());
}

void ContactScene::update_energy() {
  const double kinetic = kinetic_energy(model_, simulation_->state());
  const double now = kinetic + potential_energy(model_, simulation_->state());
  max_kinetic_ = std::max(max_kinetic_, kinetic);
  energy_error_ = std::max(energy_error_, std::abs(now - start_energy_));
  rise_ = std::max(rise_, now - min_energy_);
  min_energy_ = std::min(min_energy_, now);
  if (contact_recorder) contact_recorder->record(*this, now);
}

bool ContactScene::step(double h) {
  const StepReport report = simulation_->step(scaled_step(h));
  ok_ = ok_ && report.ok();
  update_energy();
  return report.ok();
}

void ContactScene::run(double duration, double h) {
  const long steps = std::lround(duration / scaled_step(h));
  for (long n = 0; n < steps; ++n) step(h);
}

Vector3 ContactScene::force(int body) const {
  Vector3 sum = Vector3::Zero();
  for (const ContactPoint& point : contacts_->points()) {
    if (contacts_->bodies().geometry(point.contact.b).body == body) sum += point.force_W;
    if (contacts_->bodies().geometry(point.contact.a).body == body) sum -= point.force_W;
  }
  return sum;
}

// ---- recording ----

void ContactRecorder::add(const ContactScene& scene, double energy) {
  ContactRun& run = runs.back();
  run.t.push_back(scene.t());
  run.energy.push_back(energy);
  const std::vector<double> values = read(scene);
  run.values.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) run.values[i].push_back(values[i]);
}

void ContactRecorder::begin(const ContactScene& scene) {
  if (!read) return;
  if (is_complete()) throw Complete{};
  active_ = ++begun_ % every == 0;
  if (!active_) return;
  runs.emplace_back();
  steps_ = 0;
  stride_ = 1;
  add(scene, scene.energy());
}

void ContactRecorder::record(const ContactScene& scene, double energy) {
  if (!active_) return;
  if (scene.t() > until) {
    if (is_complete()) throw Complete{};
    return;
  }
  if (++steps_ % stride_ != 0) return;
  add(scene, energy);
  constexpr std::size_t kMax = 1200;
  ContactRun& run = runs.back();
  if (run.t.size() <= kMax) return;
  // Keeps every other point, the first included.
  const auto halve = [](std::vector<double>& values) {
    for (std::size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
    values.resize((values.size() + 1) / 2);
  };
  halve(run.t);
  halve(run.energy);
  for (auto& values : run.values) halve(values);
  stride_ *= 2;
}

void ContactRecorder::end(double parameter, bool outcome) {
  if (!active_) return;  // a bisection without scenes
  active_ = false;
  runs.back().parameter = parameter;
  runs.back().outcome = outcome;
  if (runs.size() < 2) return;
  if (runs[0].outcome != outcome) throw Complete{};
  runs.pop_back();
}

}  // namespace twinarm
