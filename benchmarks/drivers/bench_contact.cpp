// How long the engines take for the same scenes with contacts, and how well they hold them. Prints
// JSON; the table is scripts/measure/bench's.

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "benchmarks/drivers/command_line.h"
#include "benchmarks/drivers/timing.h"
#include "benchmarks/engines/engine.h"
#include "benchmarks/scenes/eigen.h"
#include "benchmarks/scenes/mechanisms.h"
#include "collision/detection/collision_world.h"

namespace twinarm::bench {
namespace {

// How well a scene with contacts is held over a run, by one and the same measure for all engines:
// our collision detection at the coordinates that they report.
class ContactMeasure {
 public:
  explicit ContactMeasure(const TimedScene& timed);
  ~ContactMeasure();
  void take(int step, const std::vector<double>& q);  // after each step, as in Scene

  double penetration() const { return penetration_; }  // the deepest point, of the last step [m]
  double max_penetration() const { return max_; }
  // Boxes: the farthest that one of them is from its vertical at the start [m]. The ball: how far
  // it creeps in the last fifth of the run [m].
  double drift() const { return drift_; }

 private:
  struct Detection;
  TimedScene timed_;
  std::unique_ptr<Detection> detection_;
  std::array<double, 3> reference_{};
  double penetration_ = 0, max_ = 0, drift_ = 0;
};

// Where bodies are, on revolutes and free.
std::vector<Pose> poses_of(const Scene& scene, const std::vector<double>& q) {
  std::vector<Pose> poses;
  const double* at = q.data();
  for (const Body& b : scene.bodies) {
    Pose X{matrix3(b.rotation), vector3(b.position)};
    if (b.joint == Joint::free)
      X = {quaternion(at + 3).normalized().toRotationMatrix(), Vector3(at)};
    else
      X.R = X.R * Eigen::AngleAxisd(at[0], axis_of(b)).toRotationMatrix();
    if (b.parent >= 0) {
      const Pose& parent = poses[index(b.parent)];
      X = {parent.R * X.R, parent.p + parent.R * X.p};
    }
    poses.push_back(X);
    at += coordinates_of(b.joint);
  }
  return poses;
}

struct ContactMeasure::Detection {
  CollisionWorld world;
  std::vector<Pose> X_WG;  // what is fixed comes first
  std::vector<Contact> contacts;

  double deepest() {
    world.detect(X_WG, 0.0, contacts);
    double depth = 0;
    for (const Contact& contact : contacts) depth = std::max(depth, contact.depth);
    return depth;
  }
};

ContactMeasure::ContactMeasure(const TimedScene& timed)
    : timed_(timed), detection_(std::make_unique<Detection>()) {
  Detection& d = *detection_;
  const Scene& scene = timed_.scene;
  if (scene.obstacle) {
    d.world.add({"obstacle", Box{2 * vector3(scene.obstacle->half)}, 0, true});
    d.X_WG.push_back({Matrix3::Identity(), vector3(scene.obstacle->centre)});
  } else {
    d.world.add({"floor", HalfSpace{}, 0, true});
    d.X_WG.emplace_back();
  }
  for (const Body& b : scene.bodies) {
    if (b.form == Form::sphere) d.world.add({"ball", Sphere{b.half[0]}});
    if (b.form == Form::box) d.world.add({"box", Box{2 * vector3(b.half)}});
  }
  d.X_WG.resize(static_cast<std::size_t>(d.world.size()));
}

ContactMeasure::~ContactMeasure() = default;

void ContactMeasure::take(int step, const std::vector<double>& q) {
  const Scene& scene = timed_.scene;
  const std::vector<Pose> X_WB = poses_of(scene, q);
  std::size_t shape = 1;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (scene.bodies[i].form != Form::none)
      detection_->X_WG[shape++] = {X_WB[i].R,
                                   X_WB[i].p + X_WB[i].R * vector3(scene.bodies[i].form_at)};
  penetration_ = detection_->deepest();
  max_ = std::max(max_, penetration_);
  drift_ = 0;
  if (!scene.obstacle) {
    for (std::size_t i = 0; i < q.size(); i += 7)
      drift_ = std::max(drift_, std::hypot(q[i] - scene.q[i], q[i + 1] - scene.q[i + 1]));
    return;
  }
  const Vector3& tip = detection_->X_WG.back().p;
  if (step < timed_.steps - timed_.steps / 5)
    Vector3::Map(reference_.data()) = tip;
  else
    drift_ = (tip - Vector3(reference_.data())).norm();
}

using Json = nlohmann::ordered_json;

constexpr const char* usage =
    R"(Times rigid-body engines on scenes with contacts; prints JSON on stdout, progress on stderr.

  bench_contact [--models wall100,pyr55,scara] [--engines A,B] [--repetitions N] [--quick] [--list]

  --models       default: all three
  --engines      default: all of this build (--list prints their names)
  --repetitions  of the whole run, default 3; engines take turns every 50 steps
  --quick        one repetition of the first 50 steps: to see that it runs

Example: bench_contact --models pyr55 --engines "twinarm double,bullet"
Exit codes: 0 done; 2 bad option.
)";

constexpr int steps_of_a_turn = 50;  // steps of one engine, before the next one's turn
constexpr int settling = 300;        // steps; from then on the piles are at rest
constexpr double ns_per_s = 1e9;

struct Options {
  std::vector<std::string> models{timed_scene_names.begin(), timed_scene_names.end()};
  std::vector<std::string> engines;  // empty: all
  int repetitions = 3;
  bool quick = false, list = false;
};

Engines engines_of_build() {
  Engines engines;
  for (const EngineKind& kind : kinds_in_order()) {
    Engines variants = kind.make();
    if (variants.front()->is_timed_with_contacts()) engines.push_back(std::move(variants.front()));
  }
  return engines;
}

void check(const Options& o) {
  for (const std::string& model : o.models) timed_scene(model);
  std::vector<std::string> names;
  for (const auto& engine : engines_of_build()) names.push_back(engine->name());
  check_known(o.engines, names, "engine", " in this build; see --list");
}

// Of one engine in one scene.
struct Row {
  std::string engine, model;
  std::vector<double> whole, settling, rest;  // by repetition: mean time of a step [s]
  double penetration = 0, max_penetration = 0, drift = 0;
  std::optional<SolverReading> solver;  // residual the largest, times the means of all steps
  int unconverged = 0;                  // steps
};

void start(Engine& engine, const TimedScene& timed) {
  engine.load(timed.scene, engine.schemes(timed.scene).front(), timed.h);
}

// A run of its own for what it comes to: looking at it is not timed.
void observe(Engine& engine, const TimedScene& timed, Row& row) {
  start(engine, timed);
  ContactMeasure measure(timed);
  std::vector<double> q, v;
  for (int step = 0; step < timed.steps; ++step) {
    if (const std::optional<SolverReading> now = engine.watched_step()) {
      if (!row.solver) row.solver.emplace();
      row.solver->residual = std::max(row.solver->residual, now->residual);
      row.solver->detection += now->detection / timed.steps;
      row.solver->solver += now->solver / timed.steps;
      row.solver->whole += now->whole / timed.steps;
      row.unconverged += now->converged ? 0 : 1;
    }
    engine.read(q, v);
    measure.take(step, q);
  }
  row.penetration = measure.penetration();
  row.max_penetration = measure.max_penetration();
  row.drift = measure.drift();
}

void repeat(Engines& engines, const TimedScene& timed, std::vector<Row>& rows) {
  std::vector<double> first(engines.size()), then(engines.size());
  for (const auto& engine : engines) start(*engine, timed);
  for (int step = 0; step < timed.steps; step += steps_of_a_turn)
    for (std::size_t i = 0; i < engines.size(); ++i) {
      const double start = thread_seconds();
      for (int k = 0; k < steps_of_a_turn; ++k) engines[i]->step();
      (step < settling ? first : then)[i] += thread_seconds() - start;
    }
  const int early = std::min(settling, timed.steps);
  for (std::size_t i = 0; i < engines.size(); ++i) {
    rows[i].whole.push_back((first[i] + then[i]) / timed.steps);
    rows[i].settling.push_back(first[i] / early);
    rows[i].rest.push_back(then[i] / std::max(1, timed.steps - early));
  }
}

std::vector<Row> measure(const Options& options, const std::string& model, Stages& stages) {
  TimedScene timed = timed_scene(model);
  if (options.quick) timed.steps = steps_of_a_turn;
  Engines engines = engines_of_build();
  std::erase_if(engines, [&](const auto& e) { return !chosen(options.engines, e->name()); });
  std::vector<Row> rows(engines.size());
  const auto count = static_cast<double>(engines.size());
  for (std::size_t i = 0; i < engines.size(); ++i) {
    rows[i].engine = engines[i]->name(), rows[i].model = model;
    stages.begin(model + ", " + rows[i].engine + ": how it holds", 1.0 / count);
    observe(*engines[i], timed, rows[i]);
  }
  for (int repetition = 0; repetition < options.repetitions; ++repetition) {
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
               {"ns_settling", ns_per_s * median_of(row.settling)},
               {"ns_rest", ns_per_s * median_of(row.rest)},
               {"penetration", row.penetration},
               {"largest_penetration", row.max_penetration},
               {"drift", row.drift}};
  if (const auto& s = row.solver) {
    json["residual"] = s->residual;
    json["unconverged"] = row.unconverged;
    json["part_detection"] = s->detection / s->whole;
    json["part_solver"] = s->solver / s->whole;
  }
  return json;
}

int run(const Options& options) {
  if (options.list) {
    for (const auto& engine : engines_of_build()) std::cout << engine->name() << '\n';
    return 0;
  }
  Stages stages("bench_contact",
                static_cast<double>(options.models.size()) * (1 + options.repetitions));
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
  Options o;
  CommandLine line("bench_contact", usage);
  line.list("--models", o.models);
  line.list("--engines", o.engines);
  line.number("--repetitions", o.repetitions);
  line.flag("--quick", [&] { o.quick = true, o.repetitions = 1; });
  line.flag("--list", o.list);
  return line.run(
      argc, argv, [&] { return run(o); }, [&] { check(o); });
}
