// Pass 2: what the body is with all that hangs on it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/inspect/report/pass_pages.h"
#include "app/inspect/report/pass_words.h"

namespace twinarm {
namespace {

// With one degree of freedom in one line, else one line each.
void write_difference(Sheet& sheet, const std::string& equation,
                      const std::array<const char*, 3>& names,
                      const std::array<Eigen::VectorXd, 3>& v, const char* meaning,
                      const char* unit) {
  if (v[0].size() == 1) {
    const double size = std::max(std::abs(v[0][0]), std::abs(v[1][0]));
    return sheet.heading(fmt::format("{} = {} - {} = {}", equation, short_number(v[0][0], size),
                                     subtracted(v[1][0], size), short_number(v[2][0], size)),
                         meaning, unit);
  }
  sheet.heading(equation, meaning, unit);
  for (std::size_t k = 0; k < 3; ++k)
    sheet.line(fmt::format("      {:<16}{}", names[k], name_of_number(v[k])));
}

// Where several pull at the joint, or one that is not its motor: who.
void write_tau(const Inspection& in, std::size_t i, Sheet& sheet) {
  std::string who;
  std::size_t count = 0;
  for (std::size_t dof = in.model.iv[i]; dof < in.model.iv[i] + in.model.dofs(i); ++dof)
    for (const Actor& actor : in.actors)
      for (const Actor::OnJoint& on : actor.joints)
        if (on.dof == dof && on.tau != 0 && ++count > 0)
          who +=
              fmt::format("{}{} {}", who.empty() ? "" : ", ", actor.source, short_number(on.tau));
  if (count > 0) sheet.line(wrapped("      of tau: " + who, 14));
}

void write_joint(const Inspection& in, std::size_t i, const LinkAxes& axes, double D_error,
                 Sheet& sheet) {
  const Eigen::MatrixXd S = axes.columns(in.w.S_), U = axes.columns(in.w.U);
  const Eigen::MatrixXd D = axes.square(in.w.D);
  sheet.heading("U = IA S", "force that a unit acceleration of the joint takes (n; f)",
                "kg m^2, kg m; kg m, kg");
  // Beside all of IA: of what a shifting joint does not turn, nothing but rounding is left.
  write_columns(sheet, "U", U,
                axes.show(in.w.IA[i]).cwiseAbs().rowwise().maxCoeff() * S.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd StU = S.transpose() * U, rotor = D - StU;
  const char* meaning = "felt at the joint: ancestors locked, descendants free";
  if (axes.nv() == 1) {
    const bool geared = std::abs(rotor(0, 0)) > 1e-12 * D(0, 0);
    sheet.heading(geared
                      ? fmt::format("D = S^T U + armature = {} + {} = {}", short_number(StU(0, 0)),
                                    short_number(rotor(0, 0)), short_number(D(0, 0)))
                      : fmt::format("D = S^T U = {}", short_number(D(0, 0))),
                  meaning, joint_unit(in, i, "kg m^2", "kg"));
  } else {
    sheet.heading("D = S^T U + armature", meaning, "");
    sheet.matrix(D);
  }
  sheet.line(
      fmt::format("      the same by the mass matrix (CRBA), but for {:.1e} of it", D_error));
  const Eigen::VectorXd tau = axes.joint(in.forces.tau), u = axes.joint(in.w.u);
  const Eigen::VectorXd bias = S.transpose() * axes.show(in.w.pA[i]);
  write_difference(sheet, "u = tau - S^T pA", {"tau", "S^T pA", "u"}, {tau, bias, u},
                   "left to accelerate the joint", joint_unit(in, i, "N m", "N"));
  write_tau(in, i, sheet);
}

void write_handed_on(const Inspection& in, std::size_t i, const LinkAxes& axes, Sheet& sheet) {
  const bool has_joint = axes.nv() > 0;
  sheet.heading(has_joint ? "Ia = IA - U D^-1 U^T" : "Ia = IA", "inertia that the parent feels",
                "kg m^2, kg m, kg");
  sheet.matrix(axes.show(in.trace.Ia[i]));
  sheet.heading(has_joint ? "pa = pA + Ia c + U D^-1 u" : "pa = pA + Ia c",
                "force that the parent feels (n; f)", "N m; N");
  const Force<double> turned = in.trace.Ia[i] * in.w.c[i];
  const Force<double> rest = in.trace.pa[i] - in.w.pA[i] - turned;
  std::vector<std::pair<std::string, Vector6>> terms{{"pA", axes.show(in.w.pA[i])},
                                                     {"Ia c", axes.show(turned)}};
  if (has_joint) terms.emplace_back("U D^-1 u", axes.show(rest));
  sheet.sum(terms, "pa", axes.show(in.trace.pa[i]));
}

}  // namespace

void write_second_pass(const Inspection& in, std::size_t i, double D_error, Sheet& sheet) {
  const LinkAxes axes(in, i);
  const std::vector<std::size_t> children = in.children(i);
  std::string who;
  for (const std::size_t child : children)
    who += (who.empty() ? "" : ", ") + in.model.body_name[child];
  sheet.heading(children.empty() ? "IA = I" : "IA = I + sum X^T Ia X of " + who,
                "the body with all that hangs on it", "kg m^2, kg m, kg");
  sheet.matrix(axes.show(in.w.IA[i]));
  if (in.forces.has_impedance && !axes.show(in.forces.impedance[i]).isZero(0)) {
    sheet.heading("of it impedance", "of implicit springs and dampers", "");
    sheet.matrix(axes.show(in.forces.impedance[i]));
  }
  sheet.heading(children.empty() ? "pA = p" : "pA = p + sum X^T pa",
                "force for no acceleration, all that hangs on it included (n; f)", "N m; N");
  std::vector<std::pair<std::string, Vector6>> terms{{"p", axes.show(own_force(in, i))}};
  for (const std::size_t child : children)
    terms.emplace_back("of " + in.model.body_name[child],
                       axes.show(transpose_times(in.w.Xup[child], in.trace.pa[child])));
  sheet.sum(terms, "pA", axes.show(in.w.pA[i]));
  if (axes.nv() > 0) write_joint(in, i, axes, D_error, sheet);
  if (in.parent(i) > 0) write_handed_on(in, i, axes, sheet);
}

}  // namespace twinarm
