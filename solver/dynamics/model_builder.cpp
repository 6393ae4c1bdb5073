#include "solver/dynamics/model_builder.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "solver/dynamics/dynamics.h"
#include "solver/spatial/rotation_to_axis.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

Mat3<double> to_mat3(const Matrix3& R) {
  return {from_eigen(R.row(0)), from_eigen(R.row(1)), from_eigen(R.row(2))};
}
// Pluecker transform B_X_A from the pose of B in A.
bool is_direction(const Vector3& axis) {
  return axis.norm() > 0 && axis.allFinite();
}
bool has_axis(JointType type) {
  return facts_of(type).axis != AxisUse::none;
}

void check_inertia(const std::string& where, const BodyInertia& body, DiagnosticList& faults) {
  if (!std::isfinite(body.mass) || !body.com.allFinite() || !body.inertia.allFinite())
    faults.add(where, "mass, centre of mass or inertia is not a finite number",
               "give smaller numbers", "model.not-finite");
  else if (body.mass < 0)
    faults.add(where, "mass is " + short_number_text(body.mass) + " kg, must not be negative",
               "give a mass of at least 0 kg", "model.negative");
}
void check_properties(const std::string& joint, const JointProperties& p, DiagnosticList& faults) {
  for (const auto& [what, value] : {std::pair{"armature", p.armature},
                                    {"damping", p.damping},
                                    {"Coulomb friction", p.coulomb_plus},
                                    {"Coulomb friction", p.coulomb_minus}})
    if (!(value >= 0 && std::isfinite(value)))
      faults.add(joint_called(joint),
                 std::string(what) + " is " + short_number_text(value) + ", must not be negative",
                 "give zero or a positive number", "model.negative");
  if (!std::isfinite(p.pitch))
    faults.add(joint_called(joint), "pitch is not a finite number", "give a smaller number",
               "model.not-finite");
}

Inertia<double> about_origin(const BodyInertia& body, const Matrix3& R_BL) {
  const Vector3 c = R_BL * body.com;
  const Matrix3 I = R_BL * body.inertia * R_BL.transpose() +
                    body.mass * (c.squaredNorm() * Matrix3::Identity() - c * c.transpose());
  return {body.mass, from_eigen(body.mass * c), symmetric_part_of(to_mat3(I))};
}

// By velocity: joint-space articulated inertia D (its L D L^T pivots), maximum over three
// configurations to exclude accidental singularity; 0 if it is only rounding of the composite
// inertia.
std::vector<double> articulated_inertia_by_dof(const Model<double>& model) {
  Workspace<double> w(model);
  const Forces<double> none(model);
  State<double> x(model);
  std::vector<double> largest(model.nv, 0);
  for (int configuration = 0; configuration < 3; ++configuration) {
    for (std::size_t i = 1; i < model.parent.size(); ++i)
      visit_joint(model, i, [&](auto joint) {
        std::vector<double> delta(joint.nv);
        for (std::size_t k = 0; k < joint.nv; ++k)
          delta[k] = std::sin(1.0 + static_cast<double>(3 * i + k) + configuration);
        if (joint.nv > 0) joint.integrate(&x.q[model.iq[i]], delta.data(), &x.q[model.iq[i]]);
      });
    aba(model, x, none, w);
    w.Ic = model.I;  // composite inertias as in crba()
    for (std::size_t i = model.parent.size(); i-- > 1;) {
      for (std::size_t k = 0; k < model.dofs(i); ++k) {
        const std::size_t dof = model.iv[i] + k;
        const double d = 1 / w.D_factors[w.iD[i] + k];
        const double scale = dot(w.S_[dof], w.Ic[i] * w.S_[dof]) + model.armature[dof];
        if (d > 1e-13 * scale && std::isfinite(d)) largest[dof] = std::max(largest[dof], d);
      }
      add_congruence(w.Xup[i], w.Ic[i], w.Ic[static_cast<std::size_t>(model.parent[i])]);
    }
  }
  return largest;
}

// Bodies other than the base, ascending by name, then by index.
std::vector<int> order_of(const std::vector<std::string>& names) {
  std::vector<int> order(names.size() - 1);
  std::iota(order.begin(), order.end(), 1);
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) {
    return names[static_cast<std::size_t>(i)] < names[static_cast<std::size_t>(j)];
  });
  return order;
}

// D must be positive. A zero D makes the numbers of all ancestors invalid: errors are reported from
// the tips, armature is added there in a copy of the model, and the check is repeated.
// Returns that copy.
Model<double> check_articulated_inertia(const Model<double>& model, DiagnosticList& faults) {
  Model<double> repaired = model;
  std::vector<bool> reported(model.parent.size());
  for (bool found = true; found && !faults.is_full();) {
    found = false;
    const std::vector<double> inertia = articulated_inertia_by_dof(repaired);
    std::vector<bool> invalid(model.parent.size());
    for (std::size_t i = model.parent.size(); i-- > 1;) {
      const auto first = inertia.begin() + static_cast<std::ptrdiff_t>(model.iv[i]),
                 last = first + static_cast<std::ptrdiff_t>(model.dofs(i));
      const bool zero = std::any_of(first, last, [](double d) { return !(d > 0); });
      if (zero && !invalid[i] && !reported[i]) {
        faults.add(joint_called(model.joint_name[i]), "articulated inertia along the joint is zero",
                   "add mass and inertia to link '" + model.body_name[i] +
                       "' or a descendant, or armature to the joint",
                   "model.no-inertia");
        for (std::size_t k = 0; k < model.dofs(i); ++k) repaired.armature[model.iv[i] + k] = 1;
        reported[i] = found = true;
      }
      if (zero || invalid[i]) invalid[static_cast<std::size_t>(model.parent[i])] = true;
    }
  }
  return repaired;
}

}  // namespace

std::string link_called(const std::string& name) {
  return "link '" + name + "'";
}
std::string joint_called(const std::string& name) {
  return "joint '" + name + "'";
}

void complete_tree(ModelTree& tree) {
  tree.by_body_name = order_of(tree.body_name);
  tree.by_joint_name = order_of(tree.joint_name);
  const std::size_t n = tree.parent.size();
  tree.last_child.assign(n, 0);
  tree.chain_first.assign(n, 0);
  std::vector<std::size_t> depth(n);
  std::size_t pairs = 0;
  for (std::size_t i = 1; i < n; ++i) {
    const auto p = static_cast<std::size_t>(tree.parent[i]);
    tree.last_child[p] = static_cast<int>(i);
    tree.chain_first[i] = p > 0 && p + 1 == i ? tree.chain_first[p] : i;
    depth[i] = depth[p] + 1;
    pairs += depth[i] * tree.dofs(i);
  }
  constexpr std::size_t kDeep = 7;  // mean depth from which common axes are faster: measured
  tree.is_deep = pairs > kDeep * tree.nv;
}

void ModelBuilder::check(const Body& body, int index, Names& names, DiagnosticList& faults) {
  const std::string where = link_called(body.name);
  if (body.parent < 0 || body.parent >= index)
    faults.add(where,
               "parent index is " + std::to_string(body.parent) + ", must be 0 to " +
                   std::to_string(index - 1),
               "add the parent first", "model.parent");
  if (!names.links.insert(body.name).second)
    faults.add(where, "duplicate link name", "give each link its own name", "model.name-taken");
  if (!names.joints.insert(body.joint_name).second)
    faults.add(joint_called(body.joint_name), "duplicate joint name",
               "give each joint its own name", "model.name-taken");
  if (has_axis(body.type) && !is_direction(body.axis))
    faults.add(joint_called(body.joint_name), "axis is zero or not finite",
               "give a finite axis that is not zero", "model.axis-zero");
  check_inertia(where, body.inertia, faults);
  check_properties(body.joint_name, body.properties, faults);
}

// Also appends bodies with errors, so that the indices of later bodies are correct.
void ModelBuilder::append(const Body& body, Model<double>& model, std::vector<Matrix3>& R_LB) {
  const bool known_parent = body.parent >= 0 && body.parent < model.body_count();
  const Matrix3 R_PlPb = R_LB[static_cast<std::size_t>(known_parent ? body.parent : 0)];
  R_LB.push_back(has_axis(body.type) && is_direction(body.axis) ? rotation_taking_z_to(body.axis)
                                                                : Matrix3::Identity());
  const Pose X_PbPl{R_PlPb.transpose(), Vector3::Zero()};
  const Pose X_LB{R_LB.back(), Vector3::Zero()};

  model.body_name.push_back(body.name);
  model.joint_name.push_back(body.joint_name);
  model.parent.push_back(body.parent);
  model.joint.push_back(body.type);
  model.pitch.push_back(body.type == JointType::screw ? body.properties.pitch : 0);
  model.iq.push_back(model.nq);
  model.iv.push_back(model.nv);
  model.ip.push_back(model.np);
  const Pose Xtree = X_PbPl * body.X_PJ * X_LB;
  model.Xtree.push_back({to_mat3(Xtree.R.transpose()), from_eigen(Xtree.p)});
  model.I.push_back(about_origin(body.inertia, R_LB.back().transpose()));
  model.R_BL.push_back(to_mat3(R_LB.back().transpose()));
  visit_joint<double>(body.type, 0, [&](auto joint) {
    model.nq += joint.nq;
    model.nv += joint.nv;
    if constexpr (requires { joint.np; }) model.np += joint.np;
  });
  model.armature.resize(model.nv, body.properties.armature);
  model.damping.resize(model.nv, body.properties.damping);
  model.coulomb_plus.resize(model.nv, body.properties.coulomb_plus);
  model.coulomb_minus.resize(model.nv, body.properties.coulomb_minus);
}

Model<double> ModelBuilder::build(bool kinematic) const {
  DiagnosticList faults;
  Model<double> model;
  model.gravity = from_eigen(gravity_);
  model.body_name = {"world"};
  model.joint_name = {""};
  model.parent = {-1};
  model.joint = {JointType::fixed};
  model.pitch = {0};
  model.iq = model.iv = model.ip = {0};
  model.Xtree.resize(1);
  model.I.resize(1);
  model.R_BL = {Mat3<double>::identity()};
  std::vector<Matrix3> R_LB = {Matrix3::Identity()};

  Names names;
  for (const Body& body : bodies_) {
    check(body, model.body_count(), names, faults);
    append(body, model, R_LB);
  }
  faults.check();
  complete_tree(model);
  add_mimics_to(model, faults);
  DiagnosticList ignored;
  Model<double> repaired = check_articulated_inertia(model, kinematic ? ignored : faults);
  faults.check();
  return kinematic ? repaired : model;
}

void ModelBuilder::add_mimics_to(Model<double>& model, DiagnosticList& faults) const {
  std::unordered_map<std::string, const MimicByName*> by_follower;
  for (const MimicByName& mimic : mimics_) by_follower.emplace(mimic.follower, &mimic);
  const auto leader_of = [&](MimicByName& mimic) {
    const auto found = by_follower.find(mimic.leader);
    if (found == by_follower.end()) return false;
    const MimicByName& next = *found->second;
    mimic.offset += mimic.ratio * next.offset;
    mimic.ratio *= next.ratio;
    mimic.leader = next.leader;
    return true;
  };
  if (mimics_.size() > kMaxMimics)
    return faults.add(joint_called(mimics_[kMaxMimics].follower),
                      "there are more than " + std::to_string(kMaxMimics) + " mimic joints",
                      "make some of them fixed", "model.mimic");
  for (MimicByName mimic : mimics_) {
    std::size_t hops = 0;
    while (hops <= mimics_.size() && leader_of(mimic)) ++hops;  // to the independent joint
    if (hops > mimics_.size())
      return faults.add(joint_called(mimic.follower), "its chain of mimic joints is cyclic",
                        "remove one mimic of the cycle", "model.mimic-loop");
    const int f = model.find_joint(mimic.follower), l = model.find_joint(mimic.leader);
    const auto fi = static_cast<std::size_t>(f), li = static_cast<std::size_t>(l);
    if (f < 0 || l < 0 || model.dofs(fi) != 1 || model.dofs(li) != 1)
      faults.add(joint_called(mimic.follower),
                 "mimics joint '" + mimic.leader +
                     "'; both joints must exist and have one degree of freedom",
                 "name a revolute, prismatic or screw joint", "model.mimic");
    else
      model.mimics.push_back(
          {model.iv[fi], model.iv[li], model.iq[fi], model.iq[li], mimic.ratio, mimic.offset});
  }
}

}  // namespace twinarm
