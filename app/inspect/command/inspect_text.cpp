// The pages for people: each equation of table 7.1, with the numbers put in.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/inspect/command/inspect_output.h"
#include "app/inspect/command/sheet.h"
#include "app/text_table.h"

namespace twinarm {
namespace {

std::string name_of_number(const Eigen::VectorXd& v) {
  if (v.size() == 1) return short_number(v[0], std::abs(v[0]));
  std::string text = "(";
  for (Eigen::Index k = 0; k < v.size(); ++k)
    text += (k ? ", " : "") + short_number(v[k], v.lpNorm<Eigen::Infinity>());
  return text + ")";
}

// In brackets where a minus stands before it.
std::string subtracted(double value, double scale) {
  const std::string text = short_number(value, scale);
  return text[0] == '-' ? "(" + text + ")" : text;
}

class Pages {
 public:
  Pages(const Inspection& in, const InspectView& view, const std::vector<Check>& checks)
      : in_(in), view_(view), checks_(checks), second_(subtree_errors(in)) {}

  std::string write() {
    sheet_.line(view_.title);
    sheet_.line(
        "Vectors of six: turning part | shifting part, in the link's axes, about the link's "
        "origin.");
    for (const int pass : view_.passes) write_pass(pass);
    write_balances();
    write_checks();
    for (const std::string& warning : view_.warnings) sheet_.line(wrapped("warning: " + warning));
    return sheet_.str();
  }

 private:
  void write_pass(int pass) {
    static constexpr std::array titles{
        "PASS 1, base to tips: how each body moves, and what it takes by itself",
        "PASS 2, tips to base: what each body is with all that hangs on it",
        "PASS 3, base to tips: the accelerations"};
    sheet_.line("");
    sheet_.rule('=');
    sheet_.line(
        fmt::format("{:<{}}RBDA table 7.1", titles[static_cast<std::size_t>(pass - 1)], 84));
    sheet_.rule('=');
    std::vector<std::size_t> order = view_.bodies;
    if (pass == 2) order.assign(view_.bodies.rbegin(), view_.bodies.rend());
    for (const std::size_t body : order) {
      head(body);
      if (pass == 1) write_first(body);
      if (pass == 2) write_second(body);
      if (pass == 3) write_third(body);
    }
  }

  void head(std::size_t i) {
    const std::string& joint = in_.model.joint_name[i];
    std::string text = "\n" + in_.model.body_name[i];
    text += fmt::format(", carried by {} ({}) on {}", joint.empty() ? "the base" : joint,
                        name_of(in_.model.joint[i]), in_.model.body_name[in_.parent(i)]);
    const std::size_t nv = in_.model.dofs(i);
    if (nv == 1) {
      const char* unit = in_.model.joint[i] == JointType::prismatic ? "m" : "rad";
      text += fmt::format("    q = {} {}, qd = {} {}/s", short_number(in_.x.q[in_.model.iq[i]]),
                          unit, short_number(in_.x.qd[in_.model.iv[i]]), unit);
    }
    sheet_.line(text);
  }

  std::string of_parent(std::size_t i) const { return in_.parent(i) == 0 ? "_base" : "_p"; }
  const char* unit_of(std::size_t i, const char* turn, const char* shift) const {
    return in_.model.dofs(i) > 1 ? "" : in_.model.joint[i] == JointType::prismatic ? shift : turn;
  }

  void write_columns(const char* name, const Eigen::MatrixXd& columns) {
    for (Eigen::Index k = 0; k < columns.cols(); ++k)
      sheet_.row(columns.cols() == 1 ? std::string(name) : fmt::format("{}[{}]", name, k + 1),
                 columns.col(k));
  }
  void write_inertia(const Matrix6& m) { sheet_.matrix(m); }

  void write_first(std::size_t i) {
    const LinkAxes axes(in_, i);
    const std::size_t p = in_.parent(i);
    if (axes.nv() > 0) {
      sheet_.heading("S", "how the joint lets the body move", "");
      write_columns("S", axes.columns(in_.w.S_));
    }
    sheet_.heading("Xup = XJ Xtree", "from the parent's axes E and origin r", "1, m");
    const Vector3 r = axes.shift_from_parent();
    sheet_.line(fmt::format("      r = ({}, {}, {}),  E =", short_number(r.x()),
                            short_number(r.y()), short_number(r.z())));
    sheet_.matrix(axes.turn_from_parent());

    const Motion<double> from_parent = in_.w.Xup[i] * in_.w.v[p];
    const Motion<double> vJ = in_.w.v[i] - from_parent;
    sheet_.heading("v = Xup v" + of_parent(i) + " + S qd", "spatial velocity", "rad/s; m/s");
    sheet_.sum({{"Xup v" + of_parent(i), axes.show(from_parent)}, {"S qd", axes.show(vJ)}}, "v",
               axes.show(in_.w.v[i]));
    const Motion<double> v_cross = crm(in_.w.v[i], vJ);
    sheet_.heading("c = cJ + v x S qd", "acceleration by the velocities alone", "rad/s^2; m/s^2");
    sheet_.row("c", axes.show(in_.w.c[i]));
    const Vector6 cJ = axes.show(in_.w.c[i] - v_cross);
    if (cJ.lpNorm<Eigen::Infinity>() > 1e-12) sheet_.row("of it cJ", cJ);

    const Inertia<double>& I = in_.model.I[i];
    const Vector6 h = axes.show(Force<double>{{}, I.h});
    const Vector3 com = I.m > 0 ? Vector3(h.tail<3>() / I.m) : Vector3::Zero();
    sheet_.heading("I", "inertia of the body alone", "kg m^2, kg m, kg");
    sheet_.line(fmt::format("      mass {} kg, centre of mass ({}, {}, {}) m", short_number(I.m),
                            short_number(com.x()), short_number(com.y()), short_number(com.z())));
    write_inertia(axes.show(ArticulatedInertia<double>(I)));
    sheet_.heading("p = v x* I v - f_ext", "what the body alone takes for no acceleration",
                   "N m; N");
    const Force<double> gyroscopic = crf(in_.w.v[i], I * in_.w.v[i]);
    std::vector<std::pair<std::string, Vector6>> terms{{"v x* I v", axes.show(gyroscopic)}};
    if (!axes.show(in_.forces.f_ext[i]).isZero(0))
      terms.emplace_back("- f_ext", axes.show(-in_.forces.f_ext[i]));
    sheet_.sum(terms, "p", axes.show(own_force(in_, i)));
  }

  void write_second(std::size_t i) {
    const LinkAxes axes(in_, i);
    const std::vector<std::size_t> children = in_.children(i);
    std::string who;
    for (const std::size_t child : children)
      who += (who.empty() ? "" : ", ") + in_.model.body_name[child];
    sheet_.heading(children.empty() ? "IA = I" : "IA = I + sum X^T Ia X of " + who,
                   "the body with all that hangs on it", "kg m^2, kg m, kg");
    write_inertia(axes.show(in_.w.IA[i]));
    if (in_.forces.has_impedance && !axes.show(in_.forces.impedance[i]).isZero(0)) {
      sheet_.heading("of it impedance", "of implicit springs and dampers", "");
      write_inertia(axes.show(in_.forces.impedance[i]));
    }
    sheet_.heading(children.empty() ? "pA = p" : "pA = p + sum X^T pa",
                   "force for no acceleration, all that hangs on it included", "N m; N");
    std::vector<std::pair<std::string, Vector6>> terms{{"p", axes.show(own_force(in_, i))}};
    for (const std::size_t child : children)
      terms.emplace_back("of " + in_.model.body_name[child],
                         axes.show(transpose_times(in_.w.Xup[child], in_.trace.pa[child])));
    sheet_.sum(terms, "pA", axes.show(in_.w.pA[i]));
    if (axes.nv() > 0) write_joint(i, axes);
    if (in_.parent(i) > 0) write_handed_on(i, axes);
  }

  void write_joint(std::size_t i, const LinkAxes& axes) {
    const Eigen::MatrixXd S = axes.columns(in_.w.S_), U = axes.columns(in_.w.U);
    const Eigen::MatrixXd D = axes.square(in_.w.D);
    sheet_.heading("U = IA S", "force that a unit acceleration of the joint takes",
                   "kg m^2, kg m; kg m, kg");
    write_columns("U", U);
    const Eigen::MatrixXd StU = S.transpose() * U, rotor = D - StU;
    const char* unit = unit_of(i, "kg m^2", "kg");
    if (axes.nv() == 1) {
      const bool geared = std::abs(rotor(0, 0)) > 1e-12 * D(0, 0);
      sheet_.heading(
          geared ? fmt::format("D = S^T U + armature = {} + {} = {}", short_number(StU(0, 0)),
                               short_number(rotor(0, 0)), short_number(D(0, 0)))
                 : fmt::format("D = S^T U = {}", short_number(D(0, 0))),
          "felt at the joint: ancestors locked, descendants free", unit);
    } else {
      sheet_.heading("D = S^T U + armature",
                     "felt at the joint: ancestors locked, descendants free", "");
      sheet_.matrix(D);
    }
    sheet_.line(
        fmt::format("      the same by the mass matrix, but for {:.1e} of it", second_.D[i]));
    const Eigen::VectorXd tau = axes.joint(in_.forces.tau), u = axes.joint(in_.w.u);
    const Eigen::VectorXd bias = S.transpose() * axes.show(in_.w.pA[i]);
    write_difference("u = tau - S^T pA", {"tau", "S^T pA", "u"}, {tau, bias, u},
                     "left to accelerate the joint", unit_of(i, "N m", "N"));
  }

  // With one degree of freedom in one line, else one line each.
  void write_difference(const std::string& equation, const std::array<const char*, 3>& names,
                        const std::array<Eigen::VectorXd, 3>& v, const char* meaning,
                        const char* unit) {
    if (v[0].size() == 1) {
      const double size = std::max(std::abs(v[0][0]), std::abs(v[1][0]));
      return sheet_.heading(fmt::format("{} = {} - {} = {}", equation, short_number(v[0][0], size),
                                        subtracted(v[1][0], size), short_number(v[2][0], size)),
                            meaning, unit);
    }
    sheet_.heading(equation, meaning, unit);
    for (std::size_t k = 0; k < 3; ++k)
      sheet_.line(fmt::format("      {:<16}{}", names[k], name_of_number(v[k])));
  }

  void write_handed_on(std::size_t i, const LinkAxes& axes) {
    sheet_.heading("Ia = IA - U D^-1 U^T", "inertia that the parent feels", "kg m^2, kg m, kg");
    write_inertia(axes.show(in_.trace.Ia[i]));
    sheet_.heading("pa = pA + Ia c + U D^-1 u", "force that the parent feels", "N m; N");
    const Force<double> turned = in_.trace.Ia[i] * in_.w.c[i];
    const Force<double> rest = in_.trace.pa[i] - in_.w.pA[i] - turned;
    sheet_.sum({{"pA", axes.show(in_.w.pA[i])},
                {"Ia c", axes.show(turned)},
                {"U D^-1 u", axes.show(rest)}},
               "pa", axes.show(in_.trace.pa[i]));
  }

  void write_third(std::size_t i) {
    const LinkAxes axes(in_, i);
    const Motion<double> from_parent = in_.w.Xup[i] * in_.w.a[in_.parent(i)];
    const Motion<double> before = from_parent + in_.w.c[i];
    const std::string Xa = "Xup a" + of_parent(i);
    sheet_.heading("a' = " + Xa + " + c",
                   in_.parent(i) == 0 ? "as if the joint kept still; a_base = -g"
                                      : "as if the joint kept still",
                   "rad/s^2; m/s^2");
    sheet_.sum({{Xa, axes.show(from_parent)}, {"c", axes.show(in_.w.c[i])}}, "a'",
               axes.show(before));
    if (axes.nv() > 0) {
      const Eigen::MatrixXd U = axes.columns(in_.w.U), D = axes.square(in_.w.D);
      const Eigen::VectorXd u = axes.joint(in_.w.u), qdd = axes.joint(in_.w.qdd);
      const Eigen::VectorXd felt = U.transpose() * axes.show(before);
      const char* meaning = "acceleration of the joint";
      if (axes.nv() == 1) {
        const double size = std::max(std::abs(u[0]), std::abs(felt[0]));
        sheet_.heading(
            fmt::format("qdd = D^-1 (u - U^T a') = ({} - {}) / {} = {}", short_number(u[0], size),
                        subtracted(felt[0], size), short_number(D(0, 0)), name_of_number(qdd)),
            meaning, unit_of(i, "rad/s^2", "m/s^2"));
      } else {
        sheet_.heading("qdd = D^-1 (u - U^T a')", meaning, "");
        sheet_.line(fmt::format("      {:<16}{}", "U^T a'", name_of_number(felt)));
        sheet_.line(fmt::format("      {:<16}{}", "qdd", name_of_number(qdd)));
      }
    }
    sheet_.heading("a = a' + S qdd", "spatial acceleration, with gravity as -g of the base", "");
    sheet_.sum({{"a'", axes.show(before)}, {"S qdd", axes.show(in_.w.a[i] - before)}}, "a",
               axes.show(in_.w.a[i]));
  }

  void write_balances() {
    sheet_.line("");
    sheet_.rule('=');
    sheet_.line(
        fmt::format("WRENCHES ON EACH BODY, about its link's origin, {} axes: force [N] | "
                    "torque [N m]",
                    view_.axes == BalanceAxes::world ? "world" : "link"));
    sheet_.rule('=');
    for (const std::size_t body : view_.bodies) {
      const BodyBalance balance = balance_of(in_, body, view_.axes);
      sheet_.line("\n" + in_.model.body_name[body]);
      const Vector6 size = Vector6::Constant(balance.largest);
      for (const NamedWrench& wrench : balance.wrenches)
        sheet_.row(wrench.source, (Vector6() << wrench.force, wrench.torque).finished(), size);
      sheet_.line(fmt::format("      they sum to zero, but for {:.1e} of the largest, {}",
                              balance.residual, short_number(balance.largest)));
      for (const JointBalance& joint : joint_balances(in_))
        if (joint.body == body) write_joint_balance(joint);
    }
  }
  void write_joint_balance(const JointBalance& joint) {
    double pull = 0;
    for (const JointBalance::Torque& torque : joint.torques)
      pull = std::max(pull, std::abs(torque.value));
    if (pull <= 1e-13 * joint.largest) return;  // nobody pulls at it
    std::string text = "      at its joint";
    if (in_.model.dofs(joint.body) > 1)
      text += fmt::format(" [{}]", joint.dof - in_.model.iv[joint.body] + 1);
    text += ": ";
    for (std::size_t k = 0; k < joint.torques.size(); ++k)
      text += fmt::format("{}{} {}", k ? ", " : "", joint.torques[k].source,
                          short_number(joint.torques[k].value, joint.largest));
    sheet_.line(text);
  }

  void write_checks() {
    sheet_.line("");
    sheet_.rule('=');
    sheet_.line("CHECKS by second ways, that share no pass with the first");
    sheet_.rule('=');
    TextTable table({"check", "worst error", "allowed", "at", ""});
    for (const Check& check : checks_)
      table.add({fmt::format("{:<9} {}", check.name, check.meaning),
                 fmt::format("{:.1e}", check.error), fmt::format("{:.0e}", check.tolerance),
                 check.worst, check.pass() ? "ok" : "FALLS SHORT"});
    sheet_.line(table.str());
  }

  const Inspection& in_;
  const InspectView& view_;
  const std::vector<Check>& checks_;
  SubtreeErrors second_;  // by body
  Sheet sheet_;
};

}  // namespace

std::string inspect_text(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks) {
  return Pages(in, view, checks).write();
}

}  // namespace twinarm
