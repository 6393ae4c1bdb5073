// Time and contact quality of the engines on the same scenes with contacts. Prints JSON; the table
// is made by scripts/measure/bench.

#include <nlohmann/json.hpp>

#include "benchmarks/drivers/command_line.h"
#include "benchmarks/drivers/timing.h"
#include "benchmarks/scenes/mechanisms.h"
#include "collision/detection/collision_world.h"
#include "solver/dynamics/kinematics.h"

namespace twinarm::bench {
namespace {

// Contact quality of a run: twinarm's collision detection at the coordinates that the engine
// reports.
class ContactMeasure {
 public:
  explicit ContactMeasure(const TimedScene& timed) : timed_(timed), model_(model_of(timed.scene)) {
    const Scene& scene = timed_.scene;
    if (scene.obstacle)
      world_.add({"obstacle", Box{2 * scene.obstacle->half}, 0, true});
    else
      world_.add({"floor", HalfSpace{}, 0, true});
    for (const Body& b : scene.bodies) {
      if (b.form == Form::sphere) world_.add({"ball", Sphere{b.half[0]}});
      if (b.form == Form::box) world_.add({"box", Box{2 * b.half}});
    }
    X_WG_.resize(static_cast<std::size_t>(world_.size()));
    if (scene.obstacle) X_WG_.front().p = scene.obstacle->centre;
  }

  // After each step; q as in Scene.
  void measure(int step, const std::vector<double>& q) {
    const Scene& scene = timed_.scene;
    State<double> x(model_);
    x.q = q;
    if (!scene.obstacle)  // free bodies; some engines return quaternions in single precision
      for (std::size_t i = 3; i < q.size(); i += 7) Eigen::Vector4d::Map(&x.q[i]).normalize();
    const Kinematics k = kinematics_at(model_, x);
    std::size_t shape = 1;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      if (scene.bodies[i].form != Form::none)
        X_WG_[shape++] = {k.X_WL[i + 1].R, k.X_WL[i + 1] * scene.bodies[i].form_at};
    std::vector<Contact> contacts;
    world_.detect(X_WG_, 0.0, contacts);
    penetration = drift = 0;
    for (const Contact& contact : contacts) penetration = std::max(penetration, contact.depth);
    max_penetration = std::max(max_penetration, penetration);
    if (!scene.obstacle)
      for (std::size_t i = 0; i < q.size(); i += 7)
        drift = std::max(drift, std::hypot(q[i] - scene.q[i], q[i + 1] - scene.q[i + 1]));
    else if (step < timed_.steps - timed_.steps / 5)
      reference_ = X_WG_.back().p;
    else
      drift = (X_WG_.back().p - reference_).norm();
  }

  double penetration = 0, max_penetration = 0;  // deepest point of the last step, of all [m]
  // Boxes: largest horizontal distance from the start [m]. Ball: creep in the last fifth of the run
  // [m].
  double drift = 0;

 private:
  TimedScene timed_;
  Model<double> model_;
  CollisionWorld world_;
  std::vector<Pose> X_WG_;  // the fixed shape first
  Vector3 reference_ = Vector3::Zero();
};

using Json = nlohmann::ordered_json;

constexpr int steps_per_turn = 50;  // consecutive steps of one engine
constexpr int settling = 300;       // steps until the piles are at rest
constexpr double ns_per_s = 1e9;

struct Options {
  Names models{timed_scene_names.begin(), timed_scene_names.end()};
  Names engines;  // empty: all
  bool quick = false;
  int repetitions() const { return quick ? 1 : 3; }
};

// Of one engine in one scene.
struct Row {
  std::string engine, model;
  std::vector<double> whole, rest;  // by repetition: mean time of a step [s]
  Json observed;                    // contact quality, and of the solver where known
};

void start(Engine& engine, const TimedScene& timed) {
  engine.load(timed.scene, engine.schemes(timed.scene).front(), timed.h);
}

// A separate run for the results, not timed.
Json observe(Engine& engine, const TimedScene& timed) {
  start(engine, timed);
  ContactMeasure measure(timed);
  std::optional<SolverReading> solver;  // largest residual, mean times of a step
  int unconverged = 0;                  // steps
  std::vector<double> q, v;
  for (int step = 0; step < timed.steps; ++step) {
    if (const std::optional<SolverReading> now = engine.watched_step()) {
      if (!solver) solver.emplace();
      solver->residual = std::max(solver->residual, now->residual);
      solver->detection += now->detection / timed.steps;
      solver->solver += now->solver / timed.steps;
      solver->whole += now->whole / timed.steps;
      unconverged += now->converged ? 0 : 1;
    }
    engine.read(q, v);
    measure.measure(step, q);
  }
  Json json = {{"penetration", measure.penetration},
               {"largest_penetration", measure.max_penetration},
               {"drift", measure.drift}};
  if (solver) {
    json["residual"] = solver->residual;
    json["unconverged"] = unconverged;
    json["part_detection"] = solver->detection / solver->whole;
    json["part_solver"] = solver->solver / solver->whole;
  }
  return json;
}

void repeat(Engines& engines, const TimedScene& timed, std::vector<Row>& rows) {
  std::vector<double> first(engines.size()), then(engines.size());
  for (const auto& engine : engines) start(*engine, timed);
  for (int step = 0; step < timed.steps; step += steps_per_turn)
    for (std::size_t i = 0; i < engines.size(); ++i) {
      const double start = thread_seconds();
      for (int k = 0; k < steps_per_turn; ++k) engines[i]->step();
      (step < settling ? first : then)[i] += thread_seconds() - start;
    }
  for (std::size_t i = 0; i < engines.size(); ++i) {
    rows[i].whole.push_back((first[i] + then[i]) / timed.steps);
    rows[i].rest.push_back(then[i] / std::max(1, timed.steps - settling));
  }
}

std::vector<Row> measure(const Options& options, const std::string& model, Stages& stages) {
  TimedScene timed = timed_scene(model);
  if (options.quick) timed.steps = steps_per_turn;
  Engines engines = engines_of_build(&Engine::is_timed_with_contacts);
  std::erase_if(engines, [&](const auto& e) { return !chosen(options.engines, e->name()); });
  std::vector<Row> rows(engines.size());
  const auto count = static_cast<double>(engines.size());
  for (std::size_t i = 0; i < engines.size(); ++i) {
    rows[i].engine = engines[i]->name(), rows[i].model = model;
    stages.begin(model + ", " + rows[i].engine + ": contact quality", 1.0 / count);
    rows[i].observed = observe(*engines[i], timed);
  }
  for (int repetition = 0; repetition < options.repetitions(); ++repetition) {
    stages.begin(model + ", all engines in turns");
    repeat(engines, timed, rows);
  }
  return rows;
}

Json json_of(const Row& row) {
  Json json = {{"algorithm", "contact"},
               {"engine", row.engine},
               {"model", row.model},
               {"ns", ns_per_s * median_of(row.whole)},
               {"spread", spread_of(row.whole)},
               {"ns_rest", ns_per_s * median_of(row.rest)}};
  json.update(row.observed);
  return json;
}

int run(const Options& options) {
  Stages stages("bench_contact",
                static_cast<double>(options.models.size()) * (1 + options.repetitions()));
  Json rows = Json::array();
  for (const std::string& model : options.models)
    for (const Row& row : measure(options, model, stages)) rows.push_back(json_of(row));
  std::cout << Json{{"rows", rows}}.dump(1) << '\n';
  return 0;
}

}  // namespace

}  // namespace twinarm::bench

int main(int argc, char** argv) {
  using namespace twinarm::bench;
  CLI::App program(
      "Times rigid-body engines on scenes with contacts; prints JSON on stdout, progress on "
      "stderr.",
      "bench_contact");
  Options o;
  add_names(program, "--models", o.models, "default: all", o.models);
  const Names engines = names_of(engines_of_build(&Engine::is_timed_with_contacts));
  add_names(program, "--engines", o.engines, "default: all of this build", engines);
  program.add_flag("--quick", o.quick, "one repetition of the first 50 steps");
  add_list(program, "prints the engines", engines);
  program.footer(
      "Example: bench_contact --models pyr55 --engines \"twinarm double,bullet\"\n"
      "Exit codes: 0 done; 2 bad option; 4 it failed.");
  return run_program(program, argc, argv, [&] { return run(o); });
}
