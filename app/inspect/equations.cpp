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
struct BodyEquations {
  const Inspection& in;
  std::size_t i;
  std::size_t parent = in.parent(i);
  LinkAxes axes{in, i};
  Matrix6 X = axes.show(in.w.Xup[i]);
  Matrix S = axes.columns(in.w.S_);
  bool is_driven = in.model.joint[i] == JointType::prescribed;
  const char* of_parent = parent == 0 ? "_base" : "_p";

  std::vector<Equation> first() const {
    std::vector<Equation> all;
    const Motion<double> from_parent = in.w.Xup[i] * in.w.v[parent];
    const Motion<double> vJ = in.w.v[i] - from_parent;
    const std::string Xv = std::string("Xup v") + of_parent;
    std::vector<EquationTerm> terms{
        product(Xv.c_str(), "velocity of the parent", parent, X, of(parent, in.w.v))};
    if (is_driven)
      terms.push_back({"vJ", "velocity of the prescribed motion", i, axes.show(vJ)});
    else if (has_joint())
      terms.push_back(product("S qd", "joint velocity", i, S, axes.joint(in.x.qd)));
    all.push_back(sum_of("v", std::move(terms), axes.show(in.w.v[i])));
    if (has_joint() || is_driven) {
      const Motion<double> v_x_vJ = crm(in.w.v[i], vJ);
      const Vector6 cJ = axes.show(in.w.c[i] - v_x_vJ);
      std::vector<EquationTerm> parts{{"v x S qd", "body velocity times joint velocity", i,
                                       axes.show(v_x_vJ),
                                       size_of(axes.show(in.w.v[i]), axes.show(vJ))}};
      if (size_of(cJ) > 1e-12 * std::max(parts[0].size, size_of(parts[0].value)))
        parts.push_back({"cJ", "apparent derivative of S, times qd", i, cJ});
      all.push_back(sum_of("c", std::move(parts), axes.show(in.w.c[i])));
    }
    const Force<double> gyroscopic = crf(in.w.v[i], in.model.I[i] * in.w.v[i]);
    std::vector<EquationTerm> own{
        {"v x* I v", "gyroscopic term", i, axes.show(gyroscopic),
         size_of(axes.show(in.w.v[i]), axes.show(in.model.I[i] * in.w.v[i]))}};
    const Vector6 f_ext = axes.show(in.forces.f_ext[i]);
    if (!f_ext.isZero(0)) own.push_back({"- f_ext", "external wrench, subtracted", i, -f_ext});
    all.push_back(sum_of("p", std::move(own), axes.show(bias_force(in, i))));
    return all;
  }

  std::vector<Equation> second() const {
    std::vector<Equation> all;
    std::vector<EquationTerm> inertias{{"I", "spatial inertia of the body", i,
                                        axes.show(ArticulatedInertia<double>(in.model.I[i]))}};
    if (in.forces.has_added_inertia && !axes.show(in.forces.added_inertia[i]).isZero(0))
      inertias.push_back({"added_inertia", "added inertia of implicit spring-dampers", i,
                          axes.show(in.forces.added_inertia[i])});
    std::vector<EquationTerm> forces{
        {"p", "bias force of the body", i, axes.show(bias_force(in, i))}};
    for (const std::size_t child : in.children(i)) {
      const LinkAxes its(in, child);
      const Matrix6 X_child = its.show(in.w.Xup[child]);
      const char* apparent = "contribution of a child body";
      inertias.push_back(product("X^T Ia X", apparent, child, X_child.transpose(),
                                 Matrix6(its.show(in.trace.Ia[child]) * X_child)));
      forces.push_back(
          product("X^T pa", apparent, child, X_child.transpose(), its.show(in.trace.pa[child])));
    }
    all.push_back(sum_of("IA", std::move(inertias), axes.show(in.w.IA[i])));
    all.push_back(sum_of("pA", std::move(forces), axes.show(in.w.pA[i])));
    if (has_joint()) add_joint(all);
    if (parent > 0) add_across_joint(all);
    return all;
  }

  std::vector<Equation> third() const {
    std::vector<Equation> all;
    const std::string Xa = std::string("Xup a") + of_parent;
    const Motion<double> before = in.w.Xup[i] * in.w.a[parent] + in.w.c[i];
    const Vector6 given = axes.show(before), a = axes.show(in.w.a[i]);
    const char* meaning = parent == 0 ? "gravity, as an upward acceleration of the base"
                                      : "acceleration of the parent";
    std::vector<EquationTerm> terms{
        product(Xa.c_str(), meaning, parent, X, of(parent, in.w.a)),
        {"c", "velocity-product acceleration", i, axes.show(in.w.c[i])}};
    if (!has_joint()) {
      all.push_back(sum_of("a", std::move(terms), a));
      return all;
    }
    all.push_back(sum_of("a'", std::move(terms), given));
    const Eigen::VectorXd qdd = axes.joint(in.w.qdd);
    all.push_back(sum_of(
        "D qdd",
        {{"u", "net joint force", i, axes.joint(in.w.u)},
         product("- U^T a'", "joint force for the acceleration a'", i, -U().transpose(), given)},
        D() * qdd));
    all.push_back(sum_of("a",
                         {{"a'", "acceleration for qdd = 0", i, given},
                          product("S qdd", "joint acceleration", i, S, qdd)},
                         a));
    return all;
  }

  bool has_joint() const { return axes.nv() > 0; }
  Matrix U() const { return axes.columns(in.w.U); }
  Matrix D() const { return axes.square(in.w.D); }
  // In the link axes of that body, which may be the base.
  Vector6 of(std::size_t body, const std::vector<Motion<double>>& field) const {
    const Matrix3 R_LB = to_eigen(in.model.R_BL[body]).transpose();
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
    const Matrix6 IA = axes.show(in.w.IA[i]);
    all.push_back(equation("U", "U = IA S",
                           {product("IA S", "force per unit joint acceleration", i, IA, S)}, U(),
                           axes.nv() > 1));
    std::vector<double> rotor(in.w.D.size());
    for (std::size_t k = 0; k < axes.nv(); ++k) {
      const std::size_t dof = in.model.iv[i] + k;
      rotor[in.w.iD[i] + k * axes.nv() + k] = in.model.armature[dof] + in.forces.armature[dof];
    }
    std::vector<EquationTerm> parts{
        product("S^T U", "inertia of the bodies", i, S.transpose(), U())};
    if (const Matrix armature = axes.square(rotor); !armature.isZero(0))
      parts.push_back({"armature", "rotor inertia and implicit terms", i, armature});
    all.push_back(sum_of("D", std::move(parts), D()));
    all.push_back(sum_of("u",
                         {{"tau", "joint force", i, axes.joint(in.forces.tau)},
                          product("- S^T pA", "bias force along the joint", i, -S.transpose(),
                                  axes.show(in.w.pA[i]))},
                         axes.joint(in.w.u)));
  }

  void add_across_joint(std::vector<Equation>& all) const {
    const Matrix6 IA = axes.show(in.w.IA[i]), Ia = axes.show(in.trace.Ia[i]);
    const Vector6 pA = axes.show(in.w.pA[i]), pa = axes.show(in.trace.pa[i]);
    std::vector<EquationTerm> inertias{{"IA", "articulated-body inertia", i, IA}};
    std::vector<EquationTerm> forces{{"pA", "articulated-body bias force", i, pA},
                                     product("Ia c", "force for the velocity-product acceleration",
                                             i, Ia, axes.show(in.w.c[i]))};
    if (has_joint()) {
      const Matrix UD = D().ldlt().solve(U().transpose()).transpose();
      inertias.push_back(
          product("- U D^-1 U^T", "reduction by the joint's freedom", i, -UD, U().transpose()));
      forces.push_back(
          product("U D^-1 u", "force by the net joint force", i, UD, axes.joint(in.w.u)));
    }
    all.push_back(sum_of("Ia", std::move(inertias), Ia));
    all.push_back(sum_of("pa", std::move(forces), pa));
  }
};

}  // namespace

std::vector<Equation> equations_of(const Inspection& in, int pass, std::size_t body) {
  const BodyEquations equations{in, body};
  return pass == 1 ? equations.first() : pass == 2 ? equations.second() : equations.third();
}

}  // namespace twinarm
