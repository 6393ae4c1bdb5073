
#include <fmt/format.h>

#include "app/coupling/posed_couplings.h"
#include "app/data/json_writer.h"
#include "app/data/tables.h"

namespace twinarm {
namespace {

std::string pair(double k, double b, const char* k_unit, const char* b_unit) {
  return fmt::format("k = {} {}, b = {} {}", cell(k), k_unit, cell(b), b_unit);
}
std::string gains_words(const SpringGains& gains, bool is_length) {
  return is_length ? pair(gains.k, gains.b, "N/m", "N s/m")
                   : pair(gains.k, gains.b, "N m/rad", "N m s/rad");
}

std::string two_numbers(double a, double b, const char* between = " ") {
  return cell(a) + between + cell(b);
}

std::string one_table(const Equivalents& e, double step) {
  std::string text;
  const auto add = [&](const char* name, const std::string& value, const std::string& note) {
    text += fmt::format("  {:<20} {:<38} {}\n", name, value, note);
  };
  const auto hertz = e.response.omega / (2 * std::numbers::pi);
  add("spring-damper", gains_words(e.gains, e.is_length),
      e.is_weld ? "with the frequency and damping ratio of the weld" : "as given");
  add("frequency",
      fmt::format("omega = {} rad/s ({} Hz), zeta = {}", cell(e.response.omega), cell(hertz),
                  cell(e.response.zeta)),
      fmt::format("on {} {}, all joints free", cell(e.inertia), e.is_length ? "kg" : "kg m^2"));
  if (e.wanted)
    add("requested", gains_words(*e.wanted, e.is_length), "for the requested frequency");
  if (e.as_torsional)
    add("torsional", gains_words(*e.as_torsional, false),
        fmt::format("k r^2, r = {} m: equal for small errors of this link alone", cell(e.radius)));
  if (e.solref)
    add("MuJoCo solref", two_numbers(e.solref->first, e.solref->second),
        e.solref->first < min_timeconst(step)
            ? fmt::format("timeconst dampratio; minimum at this step: {} s",
                          cell(min_timeconst(step)))
            : "timeconst [s], dampratio");
  if (e.direct)
    add("MuJoCo solref", two_numbers(e.direct->first, e.direct->second),
        "-stiffness [1/s^2], -damping [1/s]");
  add("  static stiffness", cell(e.static_stiffness) + (e.is_length ? " N/m" : " N m/rad"),
      "k / (1 - d): MuJoCo's constraint under a constant load");
  add("PhysX drive, force", two_numbers(e.force_drive.stiffness, e.force_drive.damping, ", "),
      "stiffness, damping");
  add("  acceleration",
      two_numbers(e.acceleration_drive.stiffness, e.acceleration_drive.damping, ", "),
      "per unit of inertia [1/s^2, 1/s]");
  return text;
}

void write_one(JsonWriter& json, const Equivalents& e) {
  const auto gains = [&json](const std::optional<SpringGains>& of) {
    return [&json, of] {
      json.or_null(of, [&](const SpringGains& is) {
        json.object({{"stiffness", is.k}, {"damping", is.b}});
      });
    };
  };
  const auto solref = [&json](const std::optional<Solref>& of) {
    return [&json, of] {
      json.or_null(of, [&](const Solref& is) { json.numbers({is.first, is.second}); });
    };
  };
  const SpringGains force{e.force_drive.stiffness, e.force_drive.damping};
  const SpringGains acceleration{e.acceleration_drive.stiffness, e.acceleration_drive.damping};
  json.object({{"name", e.name},
               {"kind", e.kind},
               {"inertia", e.inertia},
               {"gains", gains(e.gains)},
               {"frequency", e.response.omega},
               {"damping_ratio", e.response.zeta},
               {"wanted", gains(e.wanted)},
               {"torsional", gains(e.as_torsional)},
               {"solref", solref(e.solref)},
               {"solref_direct", solref(e.direct)},
               {"solref_static_stiffness", e.static_stiffness},
               {"drive_force", gains(force)},
               {"drive_acceleration", gains(acceleration)}});
}

}  // namespace

Equivalents equivalents_of(const SpringGains& gains, double inertia,
                           const MujocoImpedance& impedance) {
  Equivalents found;
  found.inertia = inertia;
  found.gains = gains;
  found.response = response_of(gains, inertia);
  if (gains.k > 0 && gains.b > 0) found.solref = solref_of(gains, inertia, impedance);
  if (gains.k > 0) found.direct = direct_solref_of(gains, inertia, impedance);
  found.static_stiffness = mujoco_static_stiffness(gains.k, impedance);
  found.force_drive = drive_of(gains, inertia, Drive::Mode::force);
  found.acceleration_drive = drive_of(gains, inertia, Drive::Mode::acceleration);
  return found;
}

std::vector<Equivalents> scene_equivalents(SimulateInput& input,
                                           const std::optional<SpringResponse>& wanted,
                                           const MujocoImpedance& impedance) {
  PosedCouplings posed(input);
  std::vector<Equivalents> all;
  for (std::size_t c = 0; c < input.couplings->size(); ++c) {
    const PredictedCoupling coupling = posed.coupling(c, 1e-3);
    const SceneCoupling& spec = input.couplings->spec(c);
    if (!(coupling.gains.k > 0)) continue;  // god object, damper, component of a weld
    // A weld adds inertia: a spring with its frequency on the apparent inertia alone is softer.
    const double inertia = posed.apparent_inertia(c), d = spec.reference.impedance;
    const double part = inertia / (inertia + coupling.added_inertia);
    Equivalents found =
        equivalents_of({part * coupling.gains.k, part * coupling.gains.b}, inertia,
                       coupling.added_inertia > 0 ? MujocoImpedance{d, d} : impedance);
    found.is_weld = coupling.added_inertia > 0;
    found.name = coupling.name;
    found.kind = coupling.kind;
    found.is_length = coupling.is_length;
    if (wanted) found.wanted = gains_of(*wanted, found.inertia);
    const auto body = static_cast<std::size_t>(spec.spring.body);
    for (const SpringArm& arm : coupling.arms)
      if (arm.joint == input.robot.model.joint_name[body]) {
        found.radius = arm.radius;
        found.as_torsional = torsional_of_linear(coupling.gains, arm.radius);
      }
    all.push_back(std::move(found));
  }
  return all;
}

std::string equivalents_table(const std::vector<Equivalents>& all, double step) {
  std::string text;
  bool several = false;
  for (const Equivalents& e : all) {
    if (!e.name.empty()) text += fmt::format("coupling '{}', {}\n", e.name, e.kind);
    text += one_table(e, step) + "\n";
    several = several || (e.as_torsional && all.size() > 1);
  }
  if (several)
    text += wrapped(
                "k r^2 matches one link alone. Springs on several links of a chain also act on "
                "each other's joints: compare K_q and B_q of `twinarm coupling predict`.") +
            "\n";
  return text;
}

std::string equivalents_json(const std::vector<Equivalents>& all) {
  return answer_text([&](JsonWriter& json) {
    json.key("couplings").list(all, [&](const Equivalents& e) { write_one(json, e); });
  });
}

}  // namespace twinarm
