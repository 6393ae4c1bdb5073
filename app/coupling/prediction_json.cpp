// SI units, radians; null without limit.
#include "app/coupling/prediction.h"
#include "app/data/json_writer.h"

namespace twinarm {
namespace {

constexpr std::array<const char*, 4> kSmoothNames{"cubic", "quintic", "cosine", "bang_bang"};

void write_coupling(JsonWriter& json, const PredictedCoupling& c) {
  const auto write_arm = [&](const SpringArm& arm) {
    json.object({{"joint", arm.joint},
                 {"radius", arm.radius},
                 {"target_radius", arm.target_radius},
                 {"largest_target_radius", arm.max_target_radius},
                 {"largest_torque", arm.max_torque}});
  };
  json.object({{"name", c.name},
               {"kind", c.kind},
               {"discretization", c.is_own_discretization() ? "own" : name_of(c.discretization)},
               {"damper", c.absolute_damper ? "absolute" : "relative"},
               {"rate", c.rate},
               {"delay", c.delay},
               {"stiffness", c.gains.k},
               {"damping", c.gains.b},
               {"offset", c.offset},
               {"K", c.K},
               {"K_material", c.K_zero},
               {"B", c.B},
               {"frequency", c.alone.omega},
               {"damping_ratio", c.alone.zeta},
               {"arms", [&] { json.list(c.arms, write_arm); }},
               {"through_wall", c.with_wall}});
}

void write_by_rows(JsonWriter& json, const Predicted& found, const Eigen::VectorXd& values) {
  json.object([&] {
    for (std::size_t r = 0; r < found.rows.size(); ++r)
      json.put(found.rows[r], values[static_cast<Eigen::Index>(r)]);
  });
}

void write_errors(JsonWriter& json, const Predicted& found, const RowErrors& errors) {
  json.object([&] {
    write_by_rows(json.key("distance"), found, errors.distance);
    write_by_rows(json.key("start"), found, errors.start);
    write_by_rows(json.key("reversal"), found, errors.reversal);
    for (std::size_t i = 0; i < kSmoothMoves.size(); ++i)
      write_by_rows(json.key(kSmoothNames[i]), found, errors.smooth[i]);
    write_by_rows(json.key("lag"), found, errors.lag);
  });
}

void write_mode(JsonWriter& json, const Predicted& found, const PredictedMode& mode) {
  const auto write_mode_errors = [&] {
    json.members({{"start", mode.errors.start}, {"reversal", mode.errors.reversal}});
    for (std::size_t i = 0; i < kSmoothMoves.size(); ++i)
      json.put(kSmoothNames[i], mode.errors.smooth[i]);
    json.members({{"absolute_damper_lag", mode.errors.absolute_lag},
                  {"mocap_weld_lag", mode.errors.weld_lag}});
  };
  json.object({{"frequency", mode.omega},
               {"damping_ratio", mode.zeta},
               {"shape", [&] { write_by_rows(json, found, mode.shape); }},
               {"errors", [&] { json.object(write_mode_errors); }}});
}

}  // namespace

std::string predicted_json(const Predicted& found, const PredictTask& task) {
  return answer_text([&](JsonWriter& json) {
    json.put("rows", found.rows);
    json.key("couplings").list(found.couplings, [&](const PredictedCoupling& c) {
      write_coupling(json, c);
    });
    json.members({{"K", found.K}, {"B", found.B}, {"mass_matrix", found.M}});
    json.key("target").object({{"distance", task.distance}, {"time", task.time}});
    json.key("modes").list(found.modes,
                           [&](const PredictedMode& mode) { write_mode(json, found, mode); });
    json.key("joint_errors").or_null(found.errors, [&](const RowErrors& errors) {
      write_errors(json, found, errors);
    });
    json.key("limits").list(found.limits, [&](const SchemeLimit& limit) {
      json.object({{"scheme", name_of(limit.scheme)},
                   {"max_stable_step", limit.max_step},
                   {"stiffness_factor_same_ratio", limit.by_ratio},
                   {"stiffness_factor_same_zeta", limit.by_zeta},
                   {"selected", limit.selected}});
    });
    json.key("scene").object({{"stepped", found.stepped},
                              {"integrator", integrator_name(found.integrator)},
                              {"step", found.step},
                              {"max_stable_step", found.max_step},
                              {"spectral_radius", found.growth},
                              {"stable", found.growth <= 1 + 1e-9}});
    write_by_rows(json.key("static_deflection"), found, found.sag);
    json.key("warnings").texts(found.warnings);
  });
}

}  // namespace twinarm
