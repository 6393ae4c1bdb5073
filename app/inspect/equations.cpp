#include "app/inspect/inspection.h"

#include <Eigen/Cholesky>

namespace twinarm {
namespace {

using Matrix = Eigen::MatrixXd;

double size_of(const Matrix& m) {
  return m.size() ? m.cwiseAbs().maxCoeff() : 0;
}
double size_of(const Matrix& a, const Matrix& b) {
  return size_of(a) * size_of(b);
}

EquationTerm product(const char* symbol, const char* words, std::size_t of, const Matrix& a,
                     const Matrix& b) {
  return {symbol, words, of, a * b, size_of(a, b)};
}

Equation equation(std::string name, std::string text, std::vector<EquationTerm> terms, Matrix value,
                  bool by_columns = false) {
  Matrix sum = Matrix::Zero(value.rows(), value.cols());
  double largest = size_of(value);
  for (const EquationTerm& term : terms) {
    sum += term.value;
    largest = std::max({largest, size_of(term.value), term.size});
  }
  const double rest = size_of(sum - value);
  return {std::move(name),  std::move(text), std::move(terms),
          std::move(value), by_columns,      rest == 0 ? 0 : rest / largest};
}

// One body's numbers, as matrices in link axes.
class BodyEquations {
 public:
  BodyEquations(const Inspection& in, std::size_t body)
      : in_(in),
        i_(body),
        parent_(in.parent(body)),
        axes_(in, body),
        X_(axes_.show(in.w.Xup[body])),
        S_(axes_.columns(in.w.S_)),
        is_driven_(in.model.joint[body] == JointType::prescribed),
        of_parent_(parent_ == 0 ? "_base" : "_p") {}

  std::vector<Equation> first() const {
    std::vector<Equation> all;
    const Motion<double> from_parent = in_.w.Xup[i_] * in_.w.v[parent_];
    const Motion<double> vJ = in_.w.v[i_] - from_parent;
    const std::string Xv = std::string("Xup v") + of_parent_;
    std::vector<EquationTerm> terms{
        product(Xv.c_str(), "velocity of the parent", parent_, X_, of(parent_, in_.w.v))};
    if (is_driven_)
      terms.push_back({"vJ", "velocity of the prescribed motion", i_, axes_.show(vJ)});
    else if (has_joint())
      terms.push_back(product("S qd", "joint velocity", i_, S_, axes_.joint(in_.x.qd)));
    all.push_back(sum_of("v", std::move(terms), axes_.show(in_.w.v[i_])));
    if (has_joint() || is_driven_) {
      const Motion<double> v_x_vJ = crm(in_.w.v[i_], vJ);
      const Vector6 cJ = axes_.show(in_.w.c[i_] - v_x_vJ);
      std::vector<EquationTerm> parts{{"v x S qd", "body velocity times joint velocity", i_,
                                       axes_.show(v_x_vJ),
                                       size_of(axes_.show(in_.w.v[i_]), axes_.show(vJ))}};
      if (size_of(cJ) > 1e-12 * std::max(parts[0].size, size_of(parts[0].value)))
        parts.push_back({"cJ", "apparent derivative of S, times qd", i_, cJ});
      all.push_back(sum_of("c", std::move(parts), axes_.show(in_.w.c[i_])));
    }
    const Force<double> gyroscopic = crf(in_.w.v[i_], in_.model.I[i_] * in_.w.v[i_]);
    std::vector<EquationTerm> own{
        {"v x* I v", "gyroscopic term", i_, axes_.show(gyroscopic),
         size_of(axes_.show(in_.w.v[i_]), axes_.show(in_.model.I[i_] * in_.w.v[i_]))}};
    const Vector6 f_ext = axes_.show(in_.forces.f_ext[i_]);
    if (!f_ext.isZero(0)) own.push_back({"- f_ext", "external wrench, subtracted", i_, -f_ext});
    all.push_back(sum_of("p", std::move(own), axes_.show(bias_force(in_, i_))));
    return all;
  }

  std::vector<Equation> second() const {
    std::vector<Equation> all;
    std::vector<EquationTerm> inertias{{"I", "spatial inertia of the body", i_,
                                        axes_.show(ArticulatedInertia<double>(in_.model.I[i_]))}};
    if (in_.forces.has_added_inertia && !axes_.show(in_.forces.added_inertia[i_]).isZero(0))
      inertias.push_back({"added_inertia", "added inertia of implicit spring-dampers", i_,
                          axes_.show(in_.forces.added_inertia[i_])});
    std::vector<EquationTerm> forces{
        {"p", "bias force of the body", i_, axes_.show(bias_force(in_, i_))}};
    for (const std::size_t child : in_.children(i_)) {
      const LinkAxes its(in_, child);
      const Matrix6 X = its.show(in_.w.Xup[child]);
      const char* apparent = "contribution of a child body";
      inertias.push_back(product("X^T Ia X", apparent, child, X.transpose(),
                                 Matrix6(its.show(in_.trace.Ia[child]) * X)));
      forces.push_back(
          product("X^T pa", apparent, child, X.transpose(), its.show(in_.trace.pa[child])));
    }
    all.push_back(sum_of("IA", std::move(inertias), axes_.show(in_.w.IA[i_])));
    all.push_back(sum_of("pA", std::move(forces), axes_.show(in_.w.pA[i_])));
    if (has_joint()) add_joint(all);
    if (parent_ > 0) add_across_joint(all);
    return all;
  }

  std::vector<Equation> third() const {
    std::vector<Equation> all;
    const std::string Xa = std::string("Xup a") + of_parent_;
    const Motion<double> before = in_.w.Xup[i_] * in_.w.a[parent_] + in_.w.c[i_];
    const Vector6 given = axes_.show(before), a = axes_.show(in_.w.a[i_]);
    const char* meaning = parent_ == 0 ? "gravity, as an upward acceleration of the base"
                                       : "acceleration of the parent";
    std::vector<EquationTerm> terms{
        product(Xa.c_str(), meaning, parent_, X_, of(parent_, in_.w.a)),
        {"c", "velocity-product acceleration", i_, axes_.show(in_.w.c[i_])}};
    if (!has_joint()) {
      all.push_back(sum_of("a", std::move(terms), a));
      return all;
    }
    all.push_back(sum_of("a'", std::move(terms), given));
    const Eigen::VectorXd qdd = axes_.joint(in_.w.qdd);
    all.push_back(sum_of(
        "D qdd",
        {{"u", "net joint force", i_, axes_.joint(in_.w.u)},
         product("- U^T a'", "joint force for the acceleration a'", i_, -U().transpose(), given)},
        D() * qdd));
    all.push_back(sum_of("a",
                         {{"a'", "acceleration for qdd = 0", i_, given},
                          product("S qdd", "joint acceleration", i_, S_, qdd)},
                         a));
    return all;
  }

 private:
  bool has_joint() const { return axes_.nv() > 0; }
  Matrix U() const { return axes_.columns(in_.w.U); }
  Matrix D() const { return axes_.square(in_.w.D); }
  // In the link axes of that body, which may be the base.
  Vector6 of(std::size_t body, const std::vector<Motion<double>>& field) const {
    const Matrix3 R_LB = to_eigen(in_.model.R_BL[body]).transpose();
    return (Vector6() << R_LB * to_eigen(field[body].w), R_LB * to_eigen(field[body].v)).finished();
  }
  static Equation sum_of(const std::string& name, std::vector<EquationTerm> terms, Matrix value) {
    std::string text = name + " =";
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const bool is_minus = terms[k].symbol.starts_with("- ");
      text += (k == 0 || is_minus ? " " : " + ") + terms[k].symbol;
    }
    return equation(name, std::move(text), std::move(terms), std::move(value));
  }

  void add_joint(std::vector<Equation>& all) const {
    const Matrix6 IA = axes_.show(in_.w.IA[i_]);
    all.push_back(equation("U", "U = IA S",
                           {product("IA S", "force per unit joint acceleration", i_, IA, S_)}, U(),
                           axes_.nv() > 1));
    std::vector<double> rotor(in_.w.D.size());
    for (std::size_t k = 0; k < axes_.nv(); ++k) {
      const std::size_t dof = in_.model.iv[i_] + k;
      rotor[in_.w.iD[i_] + k * axes_.nv() + k] = in_.model.armature[dof] + in_.forces.armature[dof];
    }
    std::vector<EquationTerm> parts{
        product("S^T U", "inertia of the bodies", i_, S_.transpose(), U())};
    if (const Matrix armature = axes_.square(rotor); !armature.isZero(0))
      parts.push_back({"armature", "rotor inertia and implicit terms", i_, armature});
    all.push_back(sum_of("D", std::move(parts), D()));
    all.push_back(sum_of("u",
                         {{"tau", "joint force", i_, axes_.joint(in_.forces.tau)},
                          product("- S^T pA", "bias force along the joint", i_, -S_.transpose(),
                                  axes_.show(in_.w.pA[i_]))},
                         axes_.joint(in_.w.u)));
  }

  void add_across_joint(std::vector<Equation>& all) const {
    const Matrix6 IA = axes_.show(in_.w.IA[i_]), Ia = axes_.show(in_.trace.Ia[i_]);
    const Vector6 pA = axes_.show(in_.w.pA[i_]), pa = axes_.show(in_.trace.pa[i_]);
    std::vector<EquationTerm> inertias{{"IA", "articulated-body inertia", i_, IA}};
    std::vector<EquationTerm> forces{{"pA", "articulated-body bias force", i_, pA},
                                     product("Ia c", "force for the velocity-product acceleration",
                                             i_, Ia, axes_.show(in_.w.c[i_]))};
    if (has_joint()) {
      const Matrix UD = D().ldlt().solve(U().transpose()).transpose();
      inertias.push_back(
          product("- U D^-1 U^T", "reduction by the joint's freedom", i_, -UD, U().transpose()));
      forces.push_back(
          product("U D^-1 u", "force by the net joint force", i_, UD, axes_.joint(in_.w.u)));
    }
    all.push_back(sum_of("Ia", std::move(inertias), Ia));
    all.push_back(sum_of("pa", std::move(forces), pa));
  }

  const Inspection& in_;
  std::size_t i_, parent_;
  LinkAxes axes_;
  Matrix6 X_;
  Matrix S_;
  bool is_driven_;
  const char* of_parent_;
};

}  // namespace

std::vector<Equation> equations_of(const Inspection& in, int pass, std::size_t body) {
  const BodyEquations equations(in, body);
  return pass == 1 ? equations.first() : pass == 2 ? equations.second() : equations.third();
}

}  // namespace twinarm
