#include "app/inspect/report/inspect_output.h"

#include <fmt/format.h>

namespace twinarm {
namespace {

// Contributions to the joint force tau.
void write_tau(const Inspection& in, std::size_t i, Sheet& sheet) {
  std::string terms;
  for (std::size_t dof = in.model.iv[i]; dof < in.model.iv[i] + in.model.dofs(i); ++dof)
    for (const AppliedForce& actor : in.actors)
      for (const AppliedForce::OnJoint& on : actor.joints)
        if (on.dof == dof && on.tau != 0)
          terms +=
              fmt::format("{}{} {}", terms.empty() ? "" : ", ", actor.source, short_number(on.tau));
  if (!terms.empty()) sheet.line(wrapped("      tau: " + terms, 11));
}

// A number, or several in parentheses.
std::string text_of(const Eigen::VectorXd& v) {
  if (v.size() == 1) return short_number(v[0], std::abs(v[0]));
  std::string text = "(";
  for (Eigen::Index k = 0; k < v.size(); ++k)
    text += (k ? ", " : "") + short_number(v[k], v.lpNorm<Eigen::Infinity>());
  return text + ")";
}

std::string three(const Vector3& v) {
  return fmt::format("({}, {}, {})", short_number(v.x()), short_number(v.y()), short_number(v.z()));
}

struct PassPage {
  const Inspection& in;
  std::size_t i;
  double D_error;
  Sheet& sheet;
  LinkAxes axes{in, i};

  // In the order of computation; quantities without an equation keep their place.
  void write(int pass) {
    const std::vector<DisplayedQuantity> all = shown_quantities(in, pass, i);
    const std::vector<Equation> equations = equations_of(in, pass, i);
    auto next = all.begin();
    for (const Equation& equation : equations) {
      const auto made = std::find_if(next, all.end(), [&](const DisplayedQuantity& shown) {
        return equation.name == shown.quantity.name;
      });
      if (made != all.end()) {
        for (; next != made; ++next) write(*next);
        ++next;
      }
      write(equation, made == all.end() ? nullptr : &*made);
    }
    for (; next != all.end(); ++next) write(*next);
  }

  void heading(const std::string& text, const DisplayedQuantity* shown) {
    if (shown)
      sheet.heading(text, shown->quantity.meaning, shown->unit);
    else
      sheet.line("  " + text);
  }

  void write(const DisplayedQuantity& shown) {
    const std::string name = shown.quantity.name;
    if (shown.value.size() == 1) return heading(name + " = " + text_of(shown.value), &shown);
    heading(name, &shown);
    if (name == "Xup") {
      sheet.line("      r = " + three(axes.translation_from_parent(in.w.Xup[i])) + ",  E =");
      return sheet.matrix(axes.rotation_from_parent(in.w.Xup[i]));
    }
    if (name == "I") write_mass();
    write_value(name, shown.value, shown.quantity.by == Quantity::By::velocity,
                shown.value.cwiseAbs());
  }
  void write_mass() {
    const Inertia<double>& I = in.model.I[i];
    const Vector6 h = axes.show(Force<double>{{}, I.h});
    const Vector3 com = I.m > 0 ? Vector3(h.tail<3>() / I.m) : Vector3::Zero();
    sheet.line(fmt::format("      mass {} kg, centre of mass {} m", short_number(I.m), three(com)));
  }
  // `size`: scale below which rounding errors are shown as 0.
  void write_value(const std::string& name, const Eigen::MatrixXd& value, bool by_columns,
                   const Eigen::MatrixXd& size) {
    if (value.rows() != 6 || (value.cols() > 1 && !by_columns))
      return value.cols() > 1 ? sheet.matrix(value) : write_numbers(name, value);
    for (Eigen::Index k = 0; k < value.cols(); ++k)
      sheet.row(value.cols() == 1 ? name : fmt::format("{}[{}]", name, k + 1), value.col(k),
                size.col(k));
  }
  void write_numbers(const std::string& name, const Eigen::VectorXd& values) {
    sheet.line(fmt::format("      {:<22}{}", name, text_of(values)));
  }

  void write(const Equation& equation, const DisplayedQuantity* shown) {
    if (equation.value.size() == 1) {
      heading(equation.text + " = " + sum_of_numbers(equation), shown);
    } else {
      heading(equation_text(equation), shown);
      write_terms(equation, shown && shown->quantity.by == Quantity::By::velocity);
    }
    if (equation.name == "D")
      sheet.line(fmt::format("      cross-check with CRBA: relative difference {:.1e}", D_error));
    if (equation.name == "u") write_tau(in, i, sheet);
  }
  // With the names of the children that contribute.
  std::string equation_text(const Equation& equation) const {
    std::string others;
    for (const EquationTerm& term : equation.terms)
      if (term.of != i && term.of != in.parent(i))
        others += (others.empty() ? "  of " : ", ") + in.model.body_name[term.of];
    return equation.text + others;
  }
  static std::string sum_of_numbers(const Equation& equation) {
    double size = std::abs(equation.value(0, 0));
    for (const EquationTerm& term : equation.terms)
      size = std::max({size, std::abs(term.value(0, 0)), term.size});
    std::string text;
    for (const EquationTerm& term : equation.terms) {
      const bool is_minus = term.symbol.starts_with("- ");
      const std::string number =
          short_number(is_minus ? -term.value(0, 0) : term.value(0, 0), size);
      text += text.empty() ? "" : is_minus ? " - " : " + ";
      text += !text.empty() && number[0] == '-' ? "(" + number + ")" : number;
    }
    const std::string sum = short_number(equation.value(0, 0), size);
    return equation.terms.size() > 1 ? text + " = " + sum : sum;
  }
  // Matrices without their terms, except for the added inertia of implicit spring-dampers.
  void write_terms(const Equation& equation, bool by_columns) {
    if (equation.value.cols() == 1 && equation.value.rows() == 6) return write_sum(equation);
    if (equation.value.cols() == 1)
      for (const EquationTerm& term : equation.terms) write_numbers(term.symbol, term.value);
    Eigen::MatrixXd size = equation.value.cwiseAbs();
    for (const EquationTerm& term : equation.terms) size = size.cwiseMax(term.size);
    write_value(equation.name, equation.value, by_columns, size);
    for (const EquationTerm& term : equation.terms)
      if (term.symbol == "added_inertia") {
        sheet.heading("added inertia, included", term.words, "");
        sheet.matrix(term.value);
      }
  }
  void write_sum(const Equation& equation) {
    std::vector<std::pair<std::string, Vector6>> terms;
    double size = 0;
    for (const EquationTerm& term : equation.terms) {
      const bool is_own = term.of == i || term.of == in.parent(i);
      terms.emplace_back(is_own ? term.symbol : "of " + in.model.body_name[term.of], term.value);
      size = std::max(size, term.size);
    }
    sheet.sum(terms, equation.name, equation.value, Vector6::Constant(size));
  }
};

}  // namespace

void write_body_head(const Inspection& in, std::size_t i, Sheet& sheet) {
  std::string text =
      fmt::format("\n{}: child of joint {} ({}), parent {}", in.model.body_name[i],
                  joint_label(in, i), name_of(in.model.joint[i]), in.model.body_name[in.parent(i)]);
  if (in.model.dofs(i) == 1) {
    const std::string unit = unit_at_joint(in.model, i, "rad; m");
    text += fmt::format("    q = {} {}, qd = {} {}/s", short_number(in.x.q[in.model.iq[i]]), unit,
                        short_number(in.x.qd[in.model.iv[i]]), unit);
  }
  sheet.line(text);
}

void write_pass(const Inspection& in, int pass, std::size_t body, double D_error, Sheet& sheet) {
  PassPage{in, body, D_error, sheet}.write(pass);
}

}  // namespace twinarm
