// Which spring or damper a step is too long for.
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/record/post_mortem.h"
#include "coupling/prediction.h"
#include "coupling/stable_pd.h"
#include "solver/dense_algebra.h"
#include "solver/dynamics.h"

namespace twinarm {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// The largest x in (0, 1] with good(x), good for all that are smaller; 0: none above 1e-12.
template <class Good>
double largest_part(Good good) {
  if (good(1.0)) return 1;
  double low = -12, high = 0;  // powers of ten
  if (!good(1e-12)) return 0;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (good(std::pow(10, middle)) ? low : high) = middle;
  }
  return std::pow(10, low);
}

struct StepMethod {
  bool known = true;
  Scheme scheme = Scheme::implicit;
  bool (*stable)(double alpha, double beta) = nullptr;  // of a method that is no Scheme
  double undamped = 0;  // limit of w h of a method that prediction.h has not; 0: it has
  std::string name;
};

StepMethod step_method_of(const SceneCoupling& coupling, Integrator integrator) {
  StepMethod method;
  // Their steps are none of prediction.h's schemes, or have no linear part.
  if (coupling.printed || coupling.law == CouplingSpec::Type::weld_like ||
      coupling.law == CouplingSpec::Type::god_object) {
    method.known = false;
    return method;
  }
  if (coupling.law == CouplingSpec::Type::stable_pd) {
    method.stable = stable_pd_is_stable;
    method.name = "stable PD";
    return method;
  }
  if (coupling.rate > 0) return {true, Scheme::hold, nullptr, 0, "held force"};
  if (coupling.treatment == Treatment::implicit) method.scheme = Scheme::implicit;
  if (coupling.treatment == Treatment::semi_implicit) method.scheme = Scheme::implicit_damper;
  if (coupling.treatment != Treatment::explicit_) {
    method.name = name_of(method.scheme);
    return method;
  }
  method.name = std::string("explicit, ") + integrator_name(integrator);
  switch (integrator) {
    case Integrator::euler:
      method.scheme = Scheme::euler;
      break;
    case Integrator::semi_implicit:
    case Integrator::semi_implicit_xv:
      method.scheme = Scheme::semi_implicit;
      break;
    case Integrator::verlet:
      method.undamped = 2;
      break;
    case Integrator::rk4:
      method.undamped = 2 * std::sqrt(2.0);
      break;
    default:
      method.known = false;
  }
  return method;
}

// Of one coupling: e'' + damping e' + w^2 e = 0. K and B of a coupling are alike but for k and b,
// so they share their modes.
struct CouplingMode {
  double w = 0, damping = 0;
};
std::vector<CouplingMode> coupling_modes(const Eigen::MatrixXd& M,
                                         const Coupling::JointSpace& space) {
  const bool by_stiffness = !space.K.isZero(0);
  const SymmetricEigensystem of = generalized_eigensystem(by_stiffness ? space.K : space.B, M);
  const Eigen::VectorXd& values = of.values;
  std::vector<CouplingMode> modes;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (!(values[i] > 1e-9 * values.maxCoeff())) continue;  // what the coupling does not move
    const Eigen::VectorXd shape = of.vectors.col(i);
    modes.push_back({by_stiffness ? std::sqrt(values[i]) : 0, shape.dot(space.B * shape)});
  }
  return modes;
}

// With the stiffness, or where there is none the damping, times `part`.
bool all_hold(const StepMethod& method, const std::vector<CouplingMode>& modes, double h,
              double part = 1) {
  return std::all_of(modes.begin(), modes.end(), [&](const CouplingMode& mode) {
    const double alpha = part * mode.w * mode.w * h * h;
    if (method.undamped > 0) return alpha <= method.undamped * method.undamped;
    const double beta = (mode.w > 0 ? 1 : part) * mode.damping * h;
    return method.stable ? method.stable(alpha, beta) : is_stable(method.scheme, alpha, beta);
  });
}

double largest_step(const StepMethod& method, const std::vector<CouplingMode>& modes) {
  constexpr double kLongest = 10;  // [s]
  if (all_hold(method, modes, kLongest)) return kNever;
  return kLongest *
         largest_part([&](double part) { return all_hold(method, modes, part * kLongest); });
}

Suspect suspect_of(const SceneCoupling& spec, const Coupling& coupling, const Kinematics& k,
                   const Eigen::MatrixXd& M, const StepMethod& method, double h) {
  Suspect suspect;
  const std::vector<CouplingMode> modes = coupling_modes(M, coupling.joint_space(k));
  double w = 0;
  for (const CouplingMode& mode : modes) w = std::max(w, mode.w > 0 ? mode.w : mode.damping);
  suspect.name = "coupling '" + spec.name + "'";
  suspect.scheme = method.name;
  suspect.is_coupling = true;
  suspect.step = spec.rate > 0 ? 1 / spec.rate : h;
  suspect.largest_step = largest_step(method, modes);
  suspect.product = w * suspect.step;
  suspect.limit = w * suspect.largest_step;
  const bool is_spring = spec.spring.k > 0,
             is_linear = spec.type == CouplingDescription::Type::linear;
  suspect.gain = is_spring ? "stiffness" : "damping";
  suspect.unit =
      std::string(is_linear ? "N" : "N m") + (is_spring ? "" : " s") + (is_linear ? "/m" : "/rad");
  if (suspect.step > suspect.largest_step)
    suspect.largest_gain =
        (is_spring ? spec.spring.k : spec.spring.b) *
        largest_part([&](double part) { return all_hold(method, modes, suspect.step, part); });
  return suspect;
}

// b h / I of dampers of joints, where the integrator takes them at the start of a step or a stage.
double damping_limit(Integrator integrator) {
  switch (integrator) {
    case Integrator::euler:
    case Integrator::midpoint:
    case Integrator::heun:
      return 2;
    case Integrator::rk4:
      return 2.785293563405282;
    default:
      return kNever;
  }
}

void add_dampers(const SimulatePlan& prepared, const Eigen::MatrixXd& M,
                 std::vector<Suspect>& suspects) {
  const Model<double>& model = prepared.input.robot.model;
  const double limit = damping_limit(prepared.run.integrator), h = prepared.run.step;
  if (limit == kNever) return;
  const Eigen::MatrixXd inverse = inverse_of(M);
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    if (model.dofs(i) == 0) continue;
    const std::size_t iv = model.iv[i];
    const double rate =
        model.damping[iv] * inverse(static_cast<Eigen::Index>(iv), static_cast<Eigen::Index>(iv));
    if (!(rate > 0)) continue;
    Suspect s;
    s.name = "damper of joint '" + model.joint_name[i] + "'";
    s.scheme = std::string("b/I for w; ") + integrator_name(prepared.run.integrator);
    s.step = h;
    s.largest_step = limit / rate;
    s.product = rate * h;
    s.limit = limit;
    s.gain = "damping";
    s.unit = "N m s/rad or N s/m";
    if (h > s.largest_step) s.largest_gain = model.damping[iv] * s.largest_step / h;
    suspects.push_back(std::move(s));
  }
}

}  // namespace

std::vector<Suspect> find_suspects(const SimulatePlan& prepared) {
  std::vector<Suspect> suspects;
  const SimulateInput& input = prepared.input;
  const Model<double>& model = input.robot.model;
  const State<double>& x = input.robot.state.x;
  if (prepared.run.is_adaptive() || model.nv == 0) return suspects;
  const Eigen::MatrixXd M = mass_matrix(model, x);
  Kinematics k(model);
  forward_kinematics(model, x, k);
  if (input.scene)
    for (std::size_t c = 0; c < input.couplings->size(); ++c) {
      const SceneCoupling& spec = input.couplings->spec(c);
      if (spec.leader != c || spec.outside) continue;  // a stop mostly does not act
      const StepMethod method = step_method_of(spec, prepared.run.integrator);
      if (method.known)
        suspects.push_back(
            suspect_of(spec, input.couplings->coupling(c), k, M, method, prepared.run.step));
    }
  add_dampers(prepared, M, suspects);
  std::stable_sort(suspects.begin(), suspects.end(), [](const Suspect& a, const Suspect& b) {
    return a.step * b.largest_step > b.step * a.largest_step;
  });
  return suspects;
}

}  // namespace twinarm
