#include "app/draw/curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/draw/palette.h"
#include "app/support/text.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

std::vector<CurveSample> sample_energy(const SceneModel*, const Snapshot& moment) {
  std::vector<CurveSample> all{{"potential", moment.potential, true}, {"kinetic", moment.kinetic}};
  if (!moment.pulls.empty()) all.push_back({"in springs", moment.elastic});
  all.push_back({"sum", moment.potential + moment.kinetic + moment.elastic, true});
  return all;
}

template <ShownCouplingForce::Kind kind>
std::vector<CurveSample> sample_pulls(const SceneModel*, const Snapshot& moment) {
  std::vector<CurveSample> all;
  for (const ShownCouplingForce& pull : moment.pulls)
    if (pull.kind == kind) all.push_back({pull.name, pull.pull_W.norm()});
  return all;
}

std::vector<CurveSample> sample_contacts(const SceneModel*, const Snapshot& moment) {
  double normal = 0, friction = 0;
  for (const ShownContact& contact : moment.contacts) {
    const double along = contact.force_W.dot(contact.n_W);
    normal += along;
    friction += (contact.force_W - along * contact.n_W).norm();
  }
  return {{"normal, all points", normal}, {"friction", friction}};
}

// Of each joint the angle between where the hand has led it and where the robot is.
std::vector<CurveSample> sample_lag(const SceneModel* scene, const Snapshot& moment) {
  std::vector<CurveSample> all;
  if (!scene) return all;
  const Model<double>& model = scene->model;
  for (const ShownTargetRobot& twin : moment.twins) {
    const auto [first, last] = scene->bodies_of_robot(twin.robot);
    for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
      if (model.joint[i] == JointType::fixed || model.joint[i] == JointType::prismatic) continue;
      const auto parent = static_cast<std::size_t>(model.parent[i]);
      const auto& X = moment.k.X_WL;
      const Matrix3 R_D = X[parent].R.transpose() * X[i].R;
      const Matrix3 R_K = twin.X_WL[parent].R.transpose() * twin.X_WL[i].R;
      // From both sine and cosine: exact for small angles too.
      const Matrix3 R = R_K.transpose() * R_D;
      const Vector3 turn(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
      const double angle = std::atan2(turn.norm(), R.trace() - 1);
      all.push_back({model.joint_name[i], angle * 180 / std::numbers::pi});
    }
  }
  return all;
}

void take_off_lowest(Plot& plot) {
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
      {"forces", "spring-dampers [N]", sample_pulls<Kind::force>},
      {"couples", "spring-dampers [N m]", sample_pulls<Kind::couple>},
      {"contacts", "contact forces [N]", sample_contacts},
      {"lag", "angle to the twin [deg]", sample_lag}};
  return all;
}

std::vector<const CurveKind*> parse_curves(const std::string& text) {
  std::vector<std::string> known;
  for (const CurveKind& kind : all_curves()) known.emplace_back(kind.name);
  std::vector<const CurveKind*> chosen;
  DiagnosticList faults;
  for (const std::string& word : split(text)) {
    if (word == "none" || word.empty()) continue;
    const auto found = std::ranges::find(known, word);
    if (found == known.end())
      faults.add({"", 0, "--plot", "there is no curve '" + word + "'",
                  name_remedy(word, known, "curves"), "option.choice"});
    else
      chosen.push_back(&all_curves()[static_cast<std::size_t>(found - known.begin())]);
  }
  faults.check();
  return chosen;
}

CurveTrace::CurveTrace(const std::vector<const CurveKind*>& kinds)
    : kinds_(kinds), plots_(kinds.size()) {
  for (std::size_t p = 0; p < plots_.size(); ++p) plots_[p].title = kinds[p]->title;
}

void CurveTrace::add(const SceneModel* scene, const Snapshot& moment) {
  for (std::size_t p = 0; p < plots_.size(); ++p) {
    Plot& plot = plots_[p];
    if (!plot.t.empty() && !(moment.x.t > plot.t.back())) continue;
    for (PlotCurve& curve : plot.curves) curve.y.push_back(kNoValue);
    for (const CurveSample& sample : kinds_[p]->sample(scene, moment)) {
      auto curve = std::ranges::find_if(plot.curves,
                                        [&](const PlotCurve& c) { return c.name == sample.name; });
      if (curve == plot.curves.end())
        curve =
            plot.curves.insert(plot.curves.end(), {sample.name, palette::curve(plot.curves.size()),
                                                   std::vector<double>(plot.t.size() + 1, kNoValue),
                                                   sample.from_lowest});
      curve->y.back() = sample.value;
    }
    plot.t.push_back(moment.x.t);
  }
}

std::vector<Plot> CurveTrace::plots() const {
  std::vector<Plot> all = plots_;
  for (std::size_t p = 0; p < all.size(); ++p) {
    if (!all[p].curves.empty()) take_off_lowest(all[p]);
    all[p].range = range_of({&all[p]});
  }
  return all;
}

}  // namespace twinarm
