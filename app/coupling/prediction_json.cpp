// The predictions for programs: SI units, radians; what has no limit is null.
#include <cmath>

#include "app/coupling/prediction.h"
#include "app/data/json_writer.h"

namespace twinarm {
namespace {

constexpr std::array<const char*, 4> kSmoothNames{"cubic", "quintic", "cosine", "bang_bang"};

void write_coupling(JsonWriter& json, const PredictedCoupling& c) {
  json.begin_object();
  json.key("name").text(c.name);
  json.key("kind").text(c.kind);
  json.key("treatment").text(c.is_own_treatment() ? "own" : word_of(c.treatment));
  json.key("damper").text(c.absolute_damper ? "absolute" : "relative");
  json.key("rate").number(c.rate);
  json.key("delay").number(c.delay);
  json.key("stiffness").number(c.gains.k);
  json.key("damping").number(c.gains.b);
  json.key("offset").number(c.offset);
  json.key("K").matrix(c.K);
  json.key("K_zero_offset").matrix(c.K_zero);
  json.key("B").matrix(c.B);
  json.key("frequency").number(c.alone.omega);
  json.key("damping_ratio").number(c.alone.zeta);
  json.key("arms").begin_array();
  for (const SpringArm& arm : c.arms) {
    json.begin_object();
    json.key("joint").text(arm.joint);
    json.key("radius").number(arm.radius);
    json.key("target_radius").number(arm.target_radius);
    json.key("largest_target_radius").number(arm.largest_target_radius);
    json.key("largest_torque").number(arm.largest_torque);
    json.end_object();
  }
  json.end_array();
  json.key("through_wall");
  c.with_wall ? json.number(*c.with_wall) : json.null();
  json.end_object();
}

void write_by_rows(JsonWriter& json, const Predicted& found, const Eigen::VectorXd& values) {
  json.begin_object();
  for (std::size_t r = 0; r < found.rows.size(); ++r)
    json.key(found.rows[r]).number(values[static_cast<Eigen::Index>(r)]);
  json.end_object();
}

void write_errors(JsonWriter& json, const Predicted& found) {
  json.key("joint_errors");
  if (!found.errors) {
    json.null();
    return;
  }
  const RowErrors& errors = *found.errors;
  json.begin_object();
  write_by_rows(json.key("distance"), found, errors.distance);
  write_by_rows(json.key("start"), found, errors.start);
  write_by_rows(json.key("reversal"), found, errors.reversal);
  for (std::size_t i = 0; i < kSmoothMoves.size(); ++i)
    write_by_rows(json.key(kSmoothNames[i]), found, errors.smooth[i]);
  write_by_rows(json.key("lag"), found, errors.lag);
  json.end_object();
}

void write_mode(JsonWriter& json, const Predicted& found, const PredictedMode& mode) {
  json.begin_object();
  json.key("frequency").number(mode.omega);
  json.key("damping_ratio").number(mode.zeta);
  write_by_rows(json.key("shape"), found, mode.shape);
  json.key("errors").begin_object();
  json.key("start").number(mode.errors.start);
  json.key("reversal").number(mode.errors.reversal);
  for (std::size_t i = 0; i < kSmoothMoves.size(); ++i)
    json.key(kSmoothNames[i]).number(mode.errors.smooth[i]);
  json.key("absolute_damper_lag").number(mode.errors.absolute_lag);
  json.key("mocap_weld_lag").number(mode.errors.weld_lag);
  json.end_object();
  json.end_object();
}

}  // namespace

std::string predicted_json(const Predicted& found, const PredictTask& task) {
  JsonWriter json;
  json.begin_object();
  json.key("rows").texts(found.rows);
  json.key("couplings").begin_array();
  for (const PredictedCoupling& c : found.couplings) write_coupling(json, c);
  json.end_array();
  json.key("K").matrix(found.K);
  json.key("B").matrix(found.B);
  json.key("mass_matrix").matrix(found.M);
  json.key("target").begin_object();
  json.key("distance").number(task.distance);
  json.key("time").number(task.time);
  json.end_object();
  json.key("modes").begin_array();
  for (const PredictedMode& mode : found.modes) write_mode(json, found, mode);
  json.end_array();
  write_errors(json, found);
  json.key("limits").begin_array();
  for (const SchemeLimit& limit : found.limits) {
    json.begin_object();
    json.key("scheme").text(name_of(limit.scheme));
    json.key("largest_step").number(limit.largest_step);
    json.key("stiffness_factor_same_ratio").number(limit.by_ratio);
    json.key("stiffness_factor_same_zeta").number(limit.by_zeta);
    json.key("is_the_scenes").boolean(limit.is_the_scenes);
    json.end_object();
  }
  json.end_array();
  json.key("scene").begin_object();
  json.key("stepped").text(found.stepped);
  json.key("integrator").text(integrator_name(found.integrator));
  json.key("step").number(found.step);
  json.key("largest_step").number(found.largest_step);
  json.key("growth_per_step").number(found.growth);
  json.key("stable").boolean(found.growth <= 1 + 1e-9);
  json.end_object();
  write_by_rows(json.key("sag"), found, found.sag);
  json.key("warnings").texts(found.warnings);
  json.end_object();
  return json.str();
}

}  // namespace twinarm
