// Pass 1: how the body moves, and what it takes by itself.
#include <fmt/format.h>

#include <cmath>

#include "app/inspect/report/pass_pages.h"
#include "app/inspect/report/pass_words.h"

namespace twinarm {
namespace {

void write_motion(const Inspection& in, std::size_t i, const LinkAxes& axes, Sheet& sheet) {
  const Motion<double> from_parent = in.w.Xup[i] * in.w.v[in.parent(i)];
  const Motion<double> vJ = in.w.v[i] - from_parent;
  const std::string Xv = "Xup v" + of_parent(in, i);
  const bool moves = axes.nv() > 0 || in.model.joint[i] == JointType::prescribed;
  sheet.heading("v = " + Xv + (moves ? " + S qd" : ""), "spatial velocity (w; v)", "rad/s; m/s");
  std::vector<std::pair<std::string, Vector6>> terms{{Xv, axes.show(from_parent)}};
  if (moves) terms.emplace_back("S qd", axes.show(vJ));
  sheet.sum(terms, "v", axes.show(in.w.v[i]));
  if (!moves) return;
  sheet.heading("c = cJ + v x S qd", "acceleration by the velocities alone", "rad/s^2; m/s^2");
  sheet.row("c", axes.show(in.w.c[i]));
  const Vector6 cJ = axes.show(in.w.c[i] - crm(in.w.v[i], vJ));
  if (cJ.lpNorm<Eigen::Infinity>() > 1e-12) sheet.row("of it cJ", cJ);
}

void write_own_inertia(const Inspection& in, std::size_t i, const LinkAxes& axes, Sheet& sheet) {
  const Inertia<double>& I = in.model.I[i];
  const Vector6 h = axes.show(Force<double>{{}, I.h});
  const Vector3 com = I.m > 0 ? Vector3(h.tail<3>() / I.m) : Vector3::Zero();
  sheet.heading("I", "inertia of the body alone", "kg m^2, kg m, kg");
  sheet.line(fmt::format("      mass {} kg, centre of mass ({}, {}, {}) m", short_number(I.m),
                         short_number(com.x()), short_number(com.y()), short_number(com.z())));
  sheet.matrix(axes.show(ArticulatedInertia<double>(I)));
}

}  // namespace

void write_first_pass(const Inspection& in, std::size_t i, Sheet& sheet) {
  const LinkAxes axes(in, i);
  if (axes.nv() > 0) {
    sheet.heading("S", "how the joint lets the body move (w; v)", "");
    write_columns(sheet, "S", axes.columns(in.w.S_), Vector6::Ones());
  }
  sheet.heading("Xup = XJ Xtree", "from the parent's axes E and origin r", "1, m");
  const Vector3 r = axes.shift_from_parent();
  sheet.line(fmt::format("      r = ({}, {}, {}),  E =", short_number(r.x()), short_number(r.y()),
                         short_number(r.z())));
  sheet.matrix(axes.turn_from_parent());
  write_motion(in, i, axes, sheet);
  write_own_inertia(in, i, axes, sheet);
  sheet.heading("p = v x* I v - f_ext", "what the body alone takes for no acceleration (n; f)",
                "N m; N");
  const Force<double> gyroscopic = crf(in.w.v[i], in.model.I[i] * in.w.v[i]);
  std::vector<std::pair<std::string, Vector6>> terms{{"v x* I v", axes.show(gyroscopic)}};
  if (!axes.show(in.forces.f_ext[i]).isZero(0))
    terms.emplace_back("- f_ext", axes.show(-in.forces.f_ext[i]));
  const Motion<double>& v = in.w.v[i];
  const Force<double> h = in.model.I[i] * v;
  const auto length = [](const Vec3<double>& a) { return std::sqrt(dot(a, a)); };
  const double shift = length(v.w) * length(h.f),
               turn = length(v.w) * length(h.n) + length(v.v) * length(h.f);
  sheet.sum(terms, "p", axes.show(own_force(in, i)),
            (Vector6() << Vector3::Constant(turn), Vector3::Constant(shift)).finished());
}

}  // namespace twinarm
