#include "app/draw/curves.h"

#include "app/draw/palette.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

std::vector<CurveSample> sample_energy(const SceneModel*, const Snapshot& snapshot) {
  std::vector<CurveSample> all{{"potential", snapshot.potential, true},
                               {"kinetic", snapshot.kinetic}};
  if (!snapshot.coupling_forces.empty()) all.push_back({"in springs", snapshot.elastic});
  all.push_back({"sum", snapshot.potential + snapshot.kinetic + snapshot.elastic, true});
  return all;
}

template <ShownCouplingForce::Kind kind>
std::vector<CurveSample> sample_coupling_forces(const SceneModel*, const Snapshot& snapshot) {
  std::vector<CurveSample> all;
  for (const ShownCouplingForce& coupling : snapshot.coupling_forces)
    if (coupling.kind == kind) all.push_back({coupling.name, coupling.force_W.norm()});
  return all;
}

std::vector<CurveSample> sample_contacts(const SceneModel*, const Snapshot& snapshot) {
  double normal = 0, friction = 0;
  for (const ShownContact& contact : snapshot.contacts) {
    const double along = contact.force_W.dot(contact.n_W);
    normal += along;
    friction += (contact.force_W - along * contact.n_W).norm();
  }
  return {{"normal, all points", normal}, {"friction", friction}};
}

// Of each joint the angle between target and robot.
std::vector<CurveSample> sample_tracking_error(const SceneModel* scene, const Snapshot& snapshot) {
  std::vector<CurveSample> all;
  if (!scene) return all;
  const Model<double>& model = scene->model;
  for (const ShownTargetRobot& target : snapshot.targets) {
    const auto [first, last] = scene->bodies_of_robot(target.robot);
    for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
      if (model.joint[i] == JointType::fixed || model.joint[i] == JointType::prismatic) continue;
      const auto parent = static_cast<std::size_t>(model.parent[i]);
      const auto& X = snapshot.k.X_WL;
      const Matrix3 R_D = X[parent].R.transpose() * X[i].R;
      const Matrix3 R_K = target.X_WL[parent].R.transpose() * target.X_WL[i].R;
      // From sine and cosine, accurate for small angles.
      const Matrix3 R = R_K.transpose() * R_D;
      const Vector3 axis(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
      const double angle = std::atan2(axis.norm(), R.trace() - 1);
      all.push_back({model.joint_name[i], angle * 180 / std::numbers::pi});
    }
  }
  return all;
}

void subtract_lowest(Plot& plot) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const double y : plot.curves.front().y)
    if (std::isfinite(y)) lowest = std::min(lowest, y);
  if (!std::isfinite(lowest)) return;
  for (PlotCurve& curve : plot.curves)
    if (curve.from_lowest)
      for (double& y : curve.y) y -= lowest;
}

}  // namespace

const std::vector<CurveKind>& all_curves() {
  using Kind = ShownCouplingForce::Kind;
  static const std::vector<CurveKind> all{
      {"energy", "energy [J]", sample_energy},
      {"forces", "spring-dampers [N]", sample_coupling_forces<Kind::force>},
      {"torques", "spring-dampers [N m]", sample_coupling_forces<Kind::couple>},
      {"contacts", "contact forces [N]", sample_contacts},
      {"tracking-error", "tracking error [deg]", sample_tracking_error}};
  return all;
}

std::vector<std::string> parse_names(const std::string& text, const std::string& option,
                                     const std::string& noun,
                                     const std::vector<std::string>& known) {
  std::vector<std::string> chosen;
  DiagnosticList faults;
  for (const std::string& word : split(text)) {
    if (word == "none" || word.empty()) continue;
    if (word == "all") return known;
    if (std::ranges::find(known, word) == known.end())
      faults.add(option, "there is no " + noun + " '" + word + "'",
                 name_remedy(word, known, noun + "s"), "option.choice");
    chosen.push_back(word);
  }
  faults.check();
  return chosen;
}

std::vector<const CurveKind*> parse_curves(const std::string& text) {
  std::vector<const CurveKind*> chosen;
  for (const std::string& name : parse_names(text, "--plot", "curve", names_of(all_curves())))
    chosen.push_back(&*std::ranges::find(all_curves(), name, &CurveKind::name));
  return chosen;
}

CurveTrace::CurveTrace(const std::vector<const CurveKind*>& kinds)
    : kinds_(kinds), plots_(kinds.size()) {
  for (std::size_t p = 0; p < plots_.size(); ++p) plots_[p].title = kinds[p]->title;
}

void CurveTrace::add(const SceneModel* scene, const Snapshot& snapshot) {
  for (std::size_t p = 0; p < plots_.size(); ++p) {
    Plot& plot = plots_[p];
    if (!plot.t.empty() && !(snapshot.x.t > plot.t.back())) continue;
    for (PlotCurve& curve : plot.curves) curve.y.push_back(kNoValue);
    for (const CurveSample& sample : kinds_[p]->sample(scene, snapshot)) {
      auto curve = std::ranges::find_if(plot.curves,
                                        [&](const PlotCurve& c) { return c.name == sample.name; });
      if (curve == plot.curves.end())
        curve =
            plot.curves.insert(plot.curves.end(), {sample.name, palette::curve(plot.curves.size()),
                                                   std::vector<double>(plot.t.size() + 1, kNoValue),
                                                   sample.from_lowest});
      curve->y.back() = sample.value;
    }
    plot.t.push_back(snapshot.x.t);
  }
}

std::vector<Plot> CurveTrace::plots() const {
  std::vector<Plot> all = plots_;
  for (std::size_t p = 0; p < all.size(); ++p) {
    if (!all[p].curves.empty()) subtract_lowest(all[p]);
    all[p].range = range_of({&all[p]});
  }
  return all;
}

}  // namespace twinarm
