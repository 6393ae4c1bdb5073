// Pass 3: the accelerations.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/inspect/report/pass_pages.h"
#include "app/inspect/report/pass_words.h"

namespace twinarm {
namespace {

void write_qdd(const Inspection& in, std::size_t i, const LinkAxes& axes,
               const Motion<double>& before, Sheet& sheet) {
  const Eigen::MatrixXd U = axes.columns(in.w.U), D = axes.square(in.w.D);
  const Eigen::VectorXd u = axes.joint(in.w.u), qdd = axes.joint(in.w.qdd);
  const Eigen::VectorXd felt = U.transpose() * axes.show(before);
  const char* meaning = "acceleration of the joint";
  if (axes.nv() == 1) {
    const double size = std::max(std::abs(u[0]), std::abs(felt[0]));
    sheet.heading(
        fmt::format("qdd = D^-1 (u - U^T a') = ({} - {}) / {} = {}", short_number(u[0], size),
                    subtracted(felt[0], size), short_number(D(0, 0)), name_of_number(qdd)),
        meaning, joint_unit(in, i, "rad/s^2", "m/s^2"));
    return;
  }
  sheet.heading("qdd = D^-1 (u - U^T a')", meaning, "");
  sheet.line(fmt::format("      {:<16}{}", "u", name_of_number(u)));
  sheet.line(fmt::format("      {:<16}{}", "U^T a'", name_of_number(felt)));
  sheet.line(fmt::format("      {:<16}{}", "qdd", name_of_number(qdd)));
}

}  // namespace

void write_third_pass(const Inspection& in, std::size_t i, Sheet& sheet) {
  const LinkAxes axes(in, i);
  const Motion<double> from_parent = in.w.Xup[i] * in.w.a[in.parent(i)];
  const Motion<double> before = from_parent + in.w.c[i];
  const std::string Xa = "Xup a" + of_parent(in, i);
  const bool has_joint = axes.nv() > 0;
  const std::string note = in.parent(i) == 0 ? "; a_base = -g" : "";
  sheet.heading((has_joint ? "a' = " : "a = ") + Xa + " + c",
                (has_joint ? "as if the joint kept still" : "spatial acceleration") + note,
                "rad/s^2; m/s^2");
  sheet.sum({{Xa, axes.show(from_parent)}, {"c", axes.show(in.w.c[i])}}, has_joint ? "a'" : "a",
            axes.show(before));
  if (!has_joint) return;
  write_qdd(in, i, axes, before, sheet);
  sheet.heading("a = a' + S qdd", "spatial acceleration; at rest it is -g", "rad/s^2; m/s^2");
  sheet.sum({{"a'", axes.show(before)}, {"S qdd", axes.show(in.w.a[i] - before)}}, "a",
            axes.show(in.w.a[i]));
}

}  // namespace twinarm
