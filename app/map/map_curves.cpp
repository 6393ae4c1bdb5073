#include "app/map/map_results.h"

#include "coupling/analysis/prediction.h"
#include "coupling/analysis/step_matrix.h"

namespace twinarm {
namespace {

constexpr double kRound = 1e-9;  // of the unit circle
constexpr int kPoses = 24;       // along the target's motion
constexpr int kMaxColumns = 96, kRows = 48;
constexpr int kHalvings = 12;  // of a row

// Whether a step of a linear system is a polynomial of its matrix.
bool is_polynomial(Integrator integrator) {
  return integrator == Integrator::euler || integrator == Integrator::midpoint ||
         integrator == Integrator::heun || integrator == Integrator::rk4;
}

bool is_stable_at(const SimulatePlan& plan, const State<double>& x) {
  const Model<double>& model = plan.input.robot.model;
  const SceneCouplings& couplings = *plan.input.couplings;
  const Kinematics k = kinematics_at(model, x);
  std::vector<CoupledTerm> parts;
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    if (!couplings.spec(c).is_first_component()) continue;
    const Coupling::JointSpace space = couplings.coupling(c).joint_space(k);
    parts.push_back({space.K, space.K, space.B, couplings.spec(c).discretization, 0});
  }
  return spectral_radius(mass_matrix(model, x), parts, plan.run.integrator, plan.run.step) <=
         1 + kRound;
}

bool is_implicit_point(const SceneCoupling& coupling) {
  return coupling.is_linear() && coupling.discretization == Discretization::implicit;
}

bool is_stable_along_motion(const SimulatePlan& plan) {
  SceneCouplings& couplings = *plan.input.couplings;
  for (std::size_t c = 0; c < couplings.size(); ++c)
    for (int i = 0; i <= kPoses && !couplings.spec(c).driven.turned.empty(); ++i)
      if (!is_stable_at(plan, couplings.target(c, plan.run.duration * i / kPoses).x)) return false;
  return true;
}

// Geometric limit of implicit linear couplings.
bool is_within_geometry(const SimulatePlan& plan) {
  SceneCouplings& couplings = *plan.input.couplings;
  const Model<double>& model = plan.input.robot.model;
  const State<double>& x = plan.input.robot.state.x;
  const Kinematics k = kinematics_at(model, x);
  for (std::size_t c = 0; c < couplings.size(); ++c)
    if (const SceneCoupling& spec = couplings.spec(c);
        is_implicit_point(spec) &&
        nearest_target_radius(model, x, k, couplings.target(c, 0).k, spec.spring, plan.run.step)
                .ratio() > 1)
      return false;
  return true;
}

// Finds where `good` changes along columns of the map.
struct BoundarySearch {
  using Good = std::function<bool(const SimulatePlan&)>;
  const MapJob& job;

  MapCurve find(const std::string& name, const Good& good) const {
    const int columns = std::min(job.nx(), kMaxColumns);
    std::vector<std::vector<double>> places;  // [column][branch], along y
    for (int i = 0; i < columns; ++i) places.push_back(column(column_at(i, columns), good));
    std::size_t branches = 0;
    for (const auto& column : places) branches = std::max(branches, column.size());
    MapCurve curve{name, {}, {}};
    for (std::size_t b = 0; b < branches; ++b) {
      if (b > 0) add(curve, NAN, NAN);
      for (int i = 0; i < columns; ++i) {
        const auto& column = places[static_cast<std::size_t>(i)];
        if (b < column.size())
          add(curve, job.x.at(column_at(i, columns)), job.y.at(column[b]));
        else if (!curve.x.empty() && !std::isnan(curve.x.back()))
          add(curve, NAN, NAN);
      }
    }
    while (!curve.x.empty() && std::isnan(curve.x.back())) curve.x.pop_back(), curve.y.pop_back();
    return curve;
  }

  static void add(MapCurve& curve, double x, double y) {
    curve.x.push_back(x);
    curve.y.push_back(y);
  }
  double column_at(int i, int columns) const {
    return static_cast<double>(i) * (job.nx() - 1) / (columns - 1);
  }
  std::vector<double> column(double u, const Good& good) const {
    const auto at = [&](double v) { return good(prepare_cell(job, job.x.at(u), job.y.at(v))); };
    const double length = job.ny() - 1;
    const int rows = std::min(job.ny() - 1, kRows);
    std::vector<double> found;
    bool before = at(0);
    for (int i = 1; i <= rows; ++i) {
      double low = length * (i - 1) / rows, high = length * i / rows;
      const bool now = at(high);
      if (now != before) {
        for (int n = 0; n < kHalvings; ++n)
          (at(0.5 * (low + high)) == before ? low : high) = 0.5 * (low + high);
        found.push_back(0.5 * (low + high));
      }
      before = now;
    }
    return found;
  }
};

bool has_theory(const SimulatePlan& plan) {
  const SceneModel& scene = *plan.input.scene;
  const Integrator integrator = plan.run.integrator;
  if (scene.couplings.empty() || !scene.constraints.empty() || !scene.springs.empty()) return false;
  if (!facts_of(integrator).implicit_force && !is_polynomial(integrator)) return false;
  return std::ranges::all_of(scene.couplings, &SceneCoupling::is_plain_spring);
}

std::string scheme_words(const SimulatePlan& plan) {
  const auto& couplings = plan.input.scene->couplings;
  const auto is_all = [&](Discretization discretization) {
    return std::ranges::all_of(
        couplings, [&](const SceneCoupling& c) { return c.discretization == discretization; });
  };
  if (!facts_of(plan.run.integrator).implicit_force) return integrator_name(plan.run.integrator);
  if (is_all(Discretization::explicit_)) return name_of(SteppingScheme::semi_implicit);
  if (is_all(Discretization::semi_implicit)) return name_of(SteppingScheme::implicit_damper);
  if (is_all(Discretization::implicit)) return name_of(SteppingScheme::implicit);
  return "semi-implicit Euler, mixed discretizations";
}

}  // namespace

std::vector<MapCurve> theory_curves(const MapJob& job) {
  std::vector<MapCurve> curves;
  const SimulatePlan corner = prepare_cell(job, job.x.from, job.y.from);
  if (!has_theory(corner)) return curves;
  const auto& couplings = corner.input.scene->couplings;
  const BoundarySearch search{job};
  const auto add = [&](const std::string& name, const BoundarySearch::Good& good) {
    MapCurve curve = search.find(name, good);
    if (!curve.x.empty()) curves.push_back(std::move(curve));
  };
  add(scheme_words(corner) + ", start pose",
      [](const SimulatePlan& plan) { return is_stable_at(plan, plan.input.robot.state.x); });
  if (std::ranges::any_of(couplings,
                          [](const SceneCoupling& c) { return !c.driven.turned.empty(); }))
    add("the same, worst pose of the target", is_stable_along_motion);
  if (std::ranges::any_of(couplings, is_implicit_point))
    add("geometric limit of implicit linear couplings", is_within_geometry);
  return curves;
}

}  // namespace twinarm
