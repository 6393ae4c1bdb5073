// Coupling types and predicted stability limits.
#include <pybind11/stl.h>

#include "app/coupling/prediction.h"
#include "app/python/arrays.h"
#include "app/python/robots.h"
#include "coupling/analysis/gains.h"

namespace twinarm::python {
namespace {

py::list coupling_types() {
  py::list all;
  for (const CouplingFacts& facts : all_couplings) {
    using Discretizations = CouplingFacts::Discretizations;
    py::dict row;
    row["name"] = facts.name;
    row["discretizations"] = facts.discretizations == Discretizations::all
                                 ? py::make_tuple("explicit", "semi-implicit", "implicit")
                             : facts.discretizations == Discretizations::explicit_only
                                 ? py::make_tuple("explicit")
                                 : py::make_tuple();
    row["at_point"] = facts.at_point;
    row["can_hold"] = facts.can_hold;
    all.append(row);
  }
  return all;
}

SteppingScheme scheme_of(const std::string& name) {
  std::string names;
  for (const SteppingScheme scheme : all_schemes) {
    if (name == name_of(scheme)) return scheme;
    names += (names.empty() ? "'" : ", '") + std::string(name_of(scheme)) + "'";
  }
  throw py::value_error("there is no scheme '" + name + "'; schemes: " + names);
}

double positive(const char* name, double value) {
  constexpr double kMax = 1e4;  // the time to compute grows with it
  if (value > 0 && value <= kMax) return value;
  throw py::value_error(std::string(name) + " must be positive, at most 1e4, is " +
                        number_text(value));
}

py::object predict(const py::object& scene, const py::object& state,
                   const std::optional<double>& step, const std::string& integrator, double turn,
                   double time, const py::object& set) {
  SimulateOptions options = run_options(scene, step, integrator, state, "", true, true, set);
  options.duration = 1;  // not used
  const PredictTask task{positive("turn", turn), positive("time", time), {}, {}};
  SimulatePlan prepared = prepare_simulation(options);
  if (!prepared.input.couplings || prepared.input.couplings->size() == 0)
    throw InputError(
        {{options.robot.model.string(), 0, "", "it has no coupling",
          "give a scene with a [[coupling]] (docs/reference/scene_file.md)", "scene.no-coupling"}});
  const std::string json = predicted_json(predict_couplings(prepared, task), task);
  return py::module_::import("json").attr("loads")(json);
}

// Square and of one size, or ValueError.
Eigen::MatrixXd square(const char* name, const py::object& given, Eigen::Index size) {
  const std::string what = std::string("largest_stable_step(): ") + name;
  const Array numbers = numbers_of(given, what);
  if (numbers.ndim() != 2 || numbers.shape(0) != numbers.shape(1) ||
      (size > 0 && numbers.shape(0) != size))
    throw py::value_error(what + " has shape " + shape_text(numbers) +
                          ", must be square, M, K and B of one size");
  check_finite(numbers.data(), static_cast<std::size_t>(numbers.size()), what);
  Eigen::MatrixXd matrix(numbers.shape(0), numbers.shape(1));
  for (Eigen::Index r = 0; r < matrix.rows(); ++r)
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) matrix(r, c) = *numbers.data(r, c);
  return matrix;
}

}  // namespace

void add_couplings(py::module_& m) {
  m.def("coupling_types", coupling_types,
        "A row for each type of [[coupling]] in a scene: name; discretizations, its "
        "discretizations (none\n"
        "for its own); at_point, whether it acts at a point; can_hold, whether its force can be\n"
        "evaluated at a rate. Laws: docs/understand/coupling_laws.md.");
  m.def(
      "schemes",
      [] {
        std::vector<std::string> names;
        for (const SteppingScheme scheme : all_schemes) names.emplace_back(name_of(scheme));
        return names;
      },
      "Names of the discretizations of a spring-damper with known stability limits.");
  m.def(
      "largest_omega_h",
      [](const std::string& scheme, double zeta) {
        if (!(zeta >= 0) || !std::isfinite(zeta))
          throw py::value_error("zeta must not be negative, is " + number_text(zeta));
        return max_omega_h(scheme_of(scheme), zeta);
      },
      py::arg("scheme"), py::arg("zeta"),
      "Stability limit of omega h for a spring-damper M e'' + b e' + k e = 0 with\n"
      "omega = sqrt(k/M) [rad/s], step h [s] and damping ratio zeta; inf without limit, 0 if no\n"
      "step is stable.");
  m.def(
      "largest_stable_step",
      [](const py::object& M, const py::object& K, const py::object& B, const std::string& scheme) {
        const Eigen::MatrixXd inertia = square("M", M, 0);
        return max_stable_step(inertia, square("K", K, inertia.rows()),
                               square("B", B, inertia.rows()), scheme_of(scheme));
      },
      py::arg("M"), py::arg("K"), py::arg("B"), py::arg("scheme"),
      "Largest step [s] below which all steps are stable, for M e'' + B e' + K e = 0 with "
      "symmetric\n"
      "(n, n) matrices [kg m^2, N m/rad, N m s/rad; of lengths kg, N/m, N s/m].");
  m.def(
      "predict_couplings", predict, py::arg("scene"), py::kw_only(), py::arg("state") = py::none(),
      py::arg("step") = py::none(), py::arg("integrator") = "", py::arg("turn") = std::numbers::pi,
      py::arg("time") = 1.0, py::arg("set") = py::none(),
      "Predicts stability limits, modes and tracking errors of a scene's couplings: the output of\n"
      "`twinarm coupling predict --json` as a dict (docs/reference/output_formats.md): K, B,\n"
      "mass_matrix, modes, limits of each scheme, sag, and in 'scene' the max_stable_step [s].\n\n"
      "  state       a state file (JSON)\n"
      "  step        [s]; default: the scene's\n"
      "  integrator  one of integrators(); default: the scene's\n"
      "  turn, time  move of the target for the tracking error [rad], [s]\n"
      "  set         {path: value}, changes of the scene as in simulate()");
}

}  // namespace twinarm::python
