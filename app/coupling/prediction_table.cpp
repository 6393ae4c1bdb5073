#include <fmt/format.h>

#include "app/coupling/prediction.h"
#include "app/data/tables.h"

namespace twinarm {
namespace {

using Eigen::Index;

constexpr double kDegrees = 180 / std::numbers::pi;

std::string paragraph(std::string_view text) {
  return wrapped(text) + "\n";
}

std::string limit_cell(double value, double unit = 1) {
  if (value == 0) return "never stable";
  return std::isinf(value) ? "none" : cell(unit * value);
}

std::string couplings_part(const Predicted& found) {
  TextTable table(
      {"coupling", "kind", "discretization", "k", "b", "target offset", "omega [rad/s]", "zeta"});
  for (const PredictedCoupling& c : found.couplings) {
    const char* word = c.is_own_discretization() ? "own" : name_of(c.discretization);
    table.add({c.name, c.kind, word, cell(c.gains.k) + (c.is_length ? " N/m" : " N m/rad"),
               cell(c.gains.b) + (c.is_length ? " N s/m" : " N m s/rad"),
               c.is_length ? cell(1e3 * c.offset) + " mm" : cell(kDegrees * c.offset) + " deg",
               cell(c.alone.omega), cell(c.alone.zeta)});
  }
  return table.str() +
         paragraph(
             "omega, zeta: highest natural frequency of this coupling alone, and its damping "
             "ratio.");
}

std::string matrix_part(const char* title, const Eigen::MatrixXd& matrix, const Predicted& found) {
  constexpr Index kMaxRows = 9;
  if (matrix.rows() > kMaxRows) return fmt::format("{}: see --json\n", title);
  const Eigen::ArrayXXd size = matrix.array().abs();
  return matrix_table(title, found.rows, (size < 1e-10 * size.maxCoeff()).select(0, matrix));
}

std::string matrices_part(const Predicted& found) {
  Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(found.K.rows(), found.K.cols());
  for (const PredictedCoupling& c : found.couplings) zero += c.K_zero;
  std::string text =
      paragraph(
          "Joint-space stiffness K_q = -d tau/dq and damping B_q of all couplings together "
          "[N m/rad, N m s/rad; prismatic joints N/m, N s/m].") +
      matrix_part("K_q", found.K, found) + matrix_part("B_q", found.B, found);
  const double geometric = (found.K - zero).cwiseAbs().maxCoeff();
  if (geometric > 1e-6 * found.K.cwiseAbs().maxCoeff())
    text +=
        paragraph(fmt::format("Geometric stiffness in K_q, from the coupling forces and the "
                              "rotation of their lever arms: up to {}; zero at zero offset.",
                              cell(geometric)));
  return text;
}

std::string modes_part(const Predicted& found) {
  std::vector<std::string> headings{"mode", "omega [rad/s]", "[Hz]", "zeta"};
  for (const std::string& row : found.rows) headings.push_back(row);
  TextTable table(headings);
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    const PredictedMode& mode = found.modes[i];
    std::vector<std::string> line{std::to_string(i + 1), cell(mode.omega),
                                  cell(mode.omega / (2 * std::numbers::pi)), cell(mode.zeta)};
    for (Index r = 0; r < mode.shape.size(); ++r)
      line.push_back(std::abs(mode.shape[r]) < 5e-4 ? "0" : fmt::format("{:.3f}", mode.shape[r]));
    table.add(line);
  }
  return paragraph(
             "Modes of M^-1 K_q: frequency, damping ratio and shape; omega = 0: damped only, "
             "without stiffness.") +
         table.str();
}

std::string errors_part(const Predicted& found, const PredictTask& task) {
  TextTable table({"mode", "start", "reversal", "cubic", "quintic", "cosine", "bang-bang",
                   "absolute lag", "weld lag"});
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    if (!(found.modes[i].omega > 0)) continue;
    const ModeErrors& e = found.modes[i].errors;
    std::vector<std::string> line{std::to_string(i + 1), cell(kDegrees * e.start),
                                  cell(kDegrees * e.reversal)};
    for (const double peak : e.smooth) line.push_back(cell(kDegrees * peak));
    line.push_back(cell(kDegrees * e.absolute_lag));
    line.push_back(cell(kDegrees * e.weld_lag));
    table.add(line);
  }
  const double D = kDegrees * task.distance;
  return paragraph(fmt::format(
             "Peak tracking error [deg] for a target that moves {:g} deg in {:g} s along a mode "
             "(lengths: [mm] for {:g} mm): velocity step, velocity reversal, and four smooth "
             "motion profiles. At constant velocity v the error of a relative damper is zero, of "
             "an absolute damper 2 zeta v/omega, of a mocap weld of this frequency 2 v timeconst, "
             "timeconst = 1/omega.",
             D, task.time, D)) +
         table.str();
}

std::string joint_errors_part(const Predicted& found, const PredictTask& task) {
  if (!found.errors) return "Peak tracking error of each joint: too many joints\n";
  TextTable table(
      {"joint", "", "start", "reversal", "cubic", "quintic", "cosine", "bang-bang", "lag"});
  const RowErrors& e = *found.errors;
  for (std::size_t r = 0; r < found.rows.size(); ++r) {
    const auto row = static_cast<Index>(r);
    const double unit = found.is_angle[r] ? kDegrees : 1e3;
    const auto word = [&](double value) { return std::isnan(value) ? "-" : cell(unit * value); };
    std::vector<std::string> line{found.rows[r], found.is_angle[r] ? "deg" : "mm",
                                  word(e.start[row]), word(e.reversal[row])};
    for (const Eigen::VectorXd& smooth : e.smooth) line.push_back(word(smooth[row]));
    line.push_back(word(e.lag[row]));
    table.add(line);
  }
  return paragraph(fmt::format(
             "Peak tracking error of each joint when all targets move at once ({:g} deg, prismatic "
             "joints {:g} mm, in {:g} s{}), with all modes and dampers; -: no coupling. Lag: "
             "steady error at constant velocity, from absolute dampers, joint damping and delays.",
             kDegrees * task.distance, 1e3 * task.slide(), task.time,
             task.along.empty() ? "" : "; shares as given by --along")) +
         table.str();
}

std::string limits_part(const Predicted& found) {
  TextTable table({"scheme", "largest step [ms]", "stiffness factor, fixed b/k", "fixed zeta", ""});
  for (const SchemeLimit& limit : found.limits)
    table.add({name_of(limit.scheme), limit_cell(limit.max_step, 1e3), limit_cell(limit.by_ratio),
               limit_cell(limit.by_zeta), limit.selected ? "<- this scene" : ""});
  std::string text =
      paragraph(fmt::format("Stability limits of all couplings together: largest stable step of "
                            "each scheme, and largest stable factor on all stiffnesses at {:g} ms, "
                            "with constant b/k or constant damping ratio.",
                            1e3 * found.step)) +
      table.str();
  return text +
         paragraph(fmt::format(
             "This scene ({}): largest step {}{}. Its step of {:g} ms {}.", found.stepped,
             limit_cell(found.max_step, 1e3),
             std::isfinite(found.max_step) && found.max_step > 0 ? " ms" : "", 1e3 * found.step,
             found.integrator == Integrator::dopri5 ? "is the upper bound of the adaptive step"
             : found.growth > 1 + 1e-9              ? "is UNSTABLE"
                                                    : "is stable"));
}

std::string loads_part(const Predicted& found) {
  TextTable sag({"joint", "deflection"});
  for (std::size_t r = 0; r < found.rows.size(); ++r) {
    const double e = found.sag[static_cast<Index>(r)];
    sag.add({found.rows[r], std::isnan(e)       ? "no coupling"
                            : found.is_angle[r] ? cell(kDegrees * e) + " deg"
                                                : cell(1e3 * e) + " mm"});
  }
  std::string text =
      paragraph("Static deflection under gravity, K_q^-1 G: target minus joint position at rest.") +
      sag.str();
  TextTable arms(
      {"point spring", "joint", "r [m]", "target R_K [m]", "max R_K [m]", "max torque [N m]"});
  TextTable walls({"coupling", "k [N/m]", "in series with the wall [N/m]"});
  bool any_arm = false, any_wall = false;
  for (const PredictedCoupling& c : found.couplings) {
    for (const SpringArm& arm : c.arms) {
      any_arm = true;
      arms.add({c.name, arm.joint, cell(arm.radius), cell(arm.target_radius),
                c.discretization == Discretization::implicit ? cell(arm.max_target_radius) : "-",
                cell(arm.max_torque)});
    }
    if (!c.with_wall) continue;
    any_wall = true;
    walls.add({c.name, cell(c.gains.k), cell(*c.with_wall)});
  }
  if (any_arm)
    text += "\n" +
            paragraph(
                "Torque of a point spring about a joint: k r R_K sin e, e the angle between "
                "the arms of point and target. An implicit point spring is stable for "
                "R_K <= max R_K (the rotation of its arm is explicit).") +
            arms.str();
  if (any_wall)
    text += "\n" + paragraph("Wall and coupling act as two springs in series.") + walls.str();
  return text;
}

}  // namespace

std::string predicted_table(const Predicted& found, const PredictTask& task) {
  return couplings_part(found) + "\n" + matrices_part(found) + "\n" + modes_part(found) + "\n" +
         errors_part(found, task) + "\n" + joint_errors_part(found, task) + "\n" +
         limits_part(found) + "\n" + loads_part(found);
}

}  // namespace twinarm
