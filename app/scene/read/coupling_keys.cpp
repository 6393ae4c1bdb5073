// The keys of [[coupling]], by the facts of the couplings (coupling/laws/coupling_spec.h).
#include <algorithm>

#include "app/scene/read/scene_keys.h"

namespace twinarm {
namespace {

using Gains = CouplingFacts::Gains;
using Sign = NumberRange::Sign;
using TargetKind = CouplingTarget::Kind;

template <Gains gains>
bool has(const CouplingFacts& facts) {
  return facts.gains == gains;
}
bool has_springs(const CouplingFacts& facts) {
  return facts.gains == Gains::spring || facts.gains == Gains::two_springs;
}
bool any_coupling(const CouplingFacts&) {
  return true;
}
template <auto... members>
double& at(CouplingDescription& coupling) {
  return (coupling.*....*members);
}

bool moves(TargetKind kind) {
  return kind != TargetKind::start && kind != TargetKind::state;
}
bool is_played(TargetKind kind) {
  return moves(kind) && kind != TargetKind::device;
}

constexpr const char* kNoGain = "this type of coupling has no such gain";
const NumberRange kPositive{Sign::positive};

}  // namespace

const std::vector<CouplingKey>& coupling_keys() {
  using C = CouplingDescription;
  using F = CouplingFacts;
  using W = WeldReference;
  // clang-format off
  static const std::vector<CouplingKey> rows{
      {.key = "measure", .has = [](const F& f) { return f.has_measure; },
       .useless = "is of a torsional coupling"},
      {.key = "point", .has = [](const F& f) { return f.at_point; },
       .useless = "this type of coupling turns the link: it has no point", .unit = "m"},
      {.key = "damper", .has = [](const F& f) { return has_springs(f) && !f.printed; },
       .useless = "this type of coupling has a damper of its own, or none"},
      {.key = "stiffness", .has = has_springs, .useless = kNoGain,
       .unit = "N/m", .turning_unit = "N m/rad", .number = at<&C::stiffness>, .added = 1000,
       .slider = {"stiffness k", 1, 1e7, "Pull per distance between the robot and its twin: "
                  "stiffer follows closer, and swings faster."},
       .turning_low = 0.01, .turning_high = 1e6},
      {.key = "damping", .has = has_springs, .useless = kNoGain,
       .unit = "N s/m", .turning_unit = "N m s/rad", .number = at<&C::damping>,
       .slider = {"damping b", 0.01, 1e5, "Pull per difference of their velocities: "
                  "it calms the swinging."},
       .turning_low = 1e-4, .turning_high = 1e4},
      {.key = "turn_stiffness", .has = has<Gains::two_springs>, .useless = "is of a bushing",
       .unit = "N m/rad", .number = at<&C::turn_stiffness>,
       .added = 0.01, .added_times = "stiffness",  // as if that had an arm of 0.1 m
       .slider = {"turn stiffness", 0.01, 1e5, "Couple per angle between the two links."}},
      {.key = "turn_damping", .has = has<Gains::two_springs>, .useless = "is of a bushing",
       .unit = "N m s/rad", .number = at<&C::turn_damping>,
       .slider = {"turn damping", 1e-4, 1e4, "Couple per difference of their rates of turn."}},
      {.key = "time_constant", .has = has<Gains::reference>, .useless = "is of a weld",
       .unit = "s", .range = kPositive, .number = at<&C::reference, &W::time_constant>,
       .slider = {"time constant", 1e-3, 1, "The weld follows as a swing of this time does."}},
      {.key = "damping_ratio", .has = has<Gains::reference>, .useless = "is of a weld",
       .range = kPositive, .number = at<&C::reference, &W::damping_ratio>,
       .slider = {"damping ratio", 0.05, 10, "1: it comes back without swinging past."}},
      {.key = "impedance", .has = has<Gains::reference>, .useless = "is of a weld",
       .range = {Sign::positive, [](double d) { return d < 1; },
                 "must be below 1: at 1 the weld would be rigid",
                 "give a number between 0 and 1, or a [[constraint]] of type \"weld\""},
       .number = at<&C::reference, &W::impedance>,
       .slider = {"impedance", 0.05, 0.999, "How firm the weld is: towards 1 as a rigid one.",
                  SliderRow::linear}},
      {.key = "rate", .has = [](const F& f) { return f.can_hold; },
       .useless = "this type of coupling is computed at every step",
       .unit = "Hz", .range = kPositive, .number = at<&C::rate>},
      {.key = "treatment", .has = [](const F& f) { return f.treatments == F::Treatments::all; },
       .useless = "this type of coupling is a treatment of its own"},
      {.key = "link", .has = [](const F& f) { return f.gains != Gains::none; },
       .useless = "a god object drives all joints"},
      {.key = "outside", .has = [](const F& f) { return f.has_measure; }},
      {.key = "delay", .has = any_coupling,
       .useless = "the target stands still: seen late, it is the same",
       .unit = "s", .number = at<&C::delay>,
       .of_target = moves, .help = "leave it out, or give a target that moves"},
      {.key = "speed", .has = any_coupling,
       .useless = "is of a target that is a motion by name or a trace",
       .range = kPositive, .number = at<&C::speed>,
       .slider = {"speed of the motion", 0.1, 10,
                  "How many times faster the twin's motion is played.", SliderRow::log, true},
       .of_target = is_played,
       .help = "leave it out, or give target = \"paper\" or a trace file"}};
  // clang-format on
  return rows;
}

const CouplingKey& coupling_key(const std::string& key) {
  const auto& rows = coupling_keys();
  return *std::find_if(rows.begin(), rows.end(),
                       [&](const CouplingKey& row) { return key == row.key; });
}

void fit_keys_to_type(Value& coupling, int line) {
  const Value* type = coupling.find("type");
  const CouplingFacts* facts = type ? find_coupling(type->text) : nullptr;
  if (!facts) return;
  for (const CouplingKey& row : coupling_keys()) {
    if (!row.has(*facts))
      std::erase_if(coupling.members, [&](const Value& member) { return member.key == row.key; });
    else if (row.is_required() && !coupling.find(row.key)) {
      const Value* other = row.added_times ? coupling.find(row.added_times) : nullptr;
      coupling.put(row.key, Value::of(other ? row.added * other->number : row.added)).line = line;
    }
  }
}

}  // namespace twinarm
