// Which spring or damper a step is too long for.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/record/post_mortem.h"
#include "coupling/prediction.h"
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
  bool known = true, held = false;
  Scheme scheme = Scheme::implicit;
  double undamped = 0;  // limit of w h of a method that prediction.h has not; 0: it has
  std::string name;
};

StepMethod step_method_of(const SceneCoupling& coupling, Integrator integrator) {
  StepMethod method;
  if (coupling.rate > 0) return {true, true, Scheme::hold, 0, "held force"};
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

// The stiffest mode of M^-1 K: w, and the damping in it.
struct StiffMode {
  double w = 0, damping = 0;
};
StiffMode stiff_mode(const Eigen::MatrixXd& M, const Coupling::JointSpace& space) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(space.K, M);
  const Eigen::VectorXd shape = modes.eigenvectors().rightCols(1);
  return {std::sqrt(std::max(0.0, modes.eigenvalues().maxCoeff())), shape.dot(space.B * shape)};
}

double limit_of(const StepMethod& method, const Eigen::MatrixXd& M,
                const Coupling::JointSpace& space) {
  const StiffMode mode = stiff_mode(M, space);
  if (method.undamped > 0) return mode.w > 0 ? method.undamped / mode.w : kNever;
  if (!method.held) return largest_stable_step(M, space.K, space.B, method.scheme);
  return 10 * largest_part([&](double part) {
           const double h = 10 * part, alpha = mode.w * mode.w * h * h;
           return alpha == 0 || is_stable(method.scheme, alpha, mode.damping * h);
         });
}

Suspect suspect_of(const SceneCoupling& spec, const Coupling& coupling, const Kinematics& k,
                   const Eigen::MatrixXd& M, const StepMethod& method, double h) {
  Suspect suspect;
  const Coupling::JointSpace space = coupling.joint_space(k);
  const double w = stiff_mode(M, space).w;
  suspect.name = "coupling '" + spec.name + "'";
  suspect.scheme = method.name;
  suspect.is_coupling = true;
  suspect.step = spec.rate > 0 ? 1 / spec.rate : h;
  suspect.largest_step = limit_of(method, M, space);
  suspect.product = w * suspect.step;
  suspect.limit = w * suspect.largest_step;
  suspect.gain = "stiffness";
  suspect.unit = spec.type == CouplingDescription::Type::linear ? "N/m" : "N m/rad";
  if (suspect.step > suspect.largest_step)
    suspect.largest_gain = spec.spring.k * largest_part([&](double part) {
                             return limit_of(method, M, {part * space.K, space.B}) >= suspect.step;
                           });
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
  const Eigen::MatrixXd inverse = M.inverse();
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
