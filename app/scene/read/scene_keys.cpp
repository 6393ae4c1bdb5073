#include "app/scene/read/scene_keys.h"

#include <fmt/format.h>

#include "app/scene/read/change_scene.h"

namespace twinarm {

using Sign = NumberRange::Sign;

// ---- the keys of surfaces ----

const std::vector<SurfaceKey>& surface_keys() {
  using P = PairDescription;
  // clang-format off
  static const std::vector<SurfaceKey> rows{
      {.key = "friction", .member = &ContactSurface::friction, .of_pair = &P::friction,
       .slider = {"friction", 0, 2, "Coulomb coefficient; a pair has the geometric mean.",
                  SliderRow::linear}},
      {.key = "restitution",
       .range = {Sign::not_negative, [](double e) { return e <= 1; },
                 "must be at most 1: an impact creates no energy", "give a number from 0 to 1"},
       .member = &ContactSurface::restitution, .of_pair = &P::restitution,
       .slider = {"restitution", 0, 1, "Speed after an impact over speed before; a pair has the "
                  "product.", SliderRow::linear}},
      {.key = "torsional_friction", .unit = "m", .member = &ContactSurface::torsional_friction,
       .slider = {.meaning = "Moment about the normal per normal force; a pair has the larger one."}},
      {.key = "rolling_friction", .unit = "m", .member = &ContactSurface::rolling_friction,
       .slider = {.meaning = "Rolling moment per normal force; a pair has the larger one."}},
      {.key = "stiffness", .unit = "N/m", .range = {Sign::positive},
       .member = &ContactSurface::stiffness, .of_pair = &P::stiffness,
       .slider = {"contact stiffness", 1e3, 1e9, "Stiffness per contact point; two surfaces are springs "
                  "in series."},
       .is_of_compliant = true},
      {.key = "dissipation", .unit = "s/m",
       .member = &ContactSurface::dissipation, .of_pair = &P::dissipation,
       .slider = {.meaning = "c of N = k d (1 + c d') per contact point; of two springs in series "
                  "the softer one has more weight."}}};
  // clang-format on
  return rows;
}

// ---- the keys of [[coupling]], by the facts of the couplings (coupling/laws/coupling_spec.h) ----

namespace {

using Gains = CouplingFacts::Gains;
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

bool is_played(TargetKind kind) {
  return CouplingTarget::is_operator(kind) && kind != TargetKind::device;
}

constexpr const char* kNoGain = "this type of coupling has no such gain";
const NumberRange kPositive{Sign::positive};

// Whether the table is a coupling with gains per angle.
bool is_torsional_table(const Value& table) {
  const Value* type = table.find("type");
  return type && type->text == "torsional";
}

// Keys without a row.
constexpr std::array<std::pair<const char*, const char*>, 18> kOtherUnits{
    {{"step", "s"},
     {"duration", "s"},
     {"accuracy", "m/s"},
     {"budget", "1/s"},
     {"sleep", "m/s"},
     {"gravity", "m/s²"},
     {"mass", "kg"},
     {"density", "kg/m³"},
     {"inertia", "kg m²"},
     {"position", "m"},
     {"point", "m"},
     {"point_b", "m"},
     {"com", "m"},
     {"offset", "m"},
     {"linear_velocity", "m/s"},
     {"linear", "m/s"},
     {"angular_velocity", "rad/s"},
     {"angular", "rad/s"}}};

struct ReferenceRow {
  std::string key, of;
  const char* unit;
  std::optional<double> by_default;
  const NumberRange& range;
  const char* meaning;
};

std::string to_markdown(const ReferenceRow& row) {
  std::string range = row.range.sign == Sign::positive ? "> 0" : ">= 0";
  if (*row.range.problem) range += std::string("; ") + row.range.problem;
  return fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", row.key, row.of, row.unit,
                     row.by_default ? short_number_text(*row.by_default) : "", range, row.meaning);
}

}  // namespace

const std::vector<CouplingKey>& coupling_keys() {
  using C = CouplingDescription;
  using F = CouplingFacts;
  using W = SolrefParameters;
  // clang-format off
  static const std::vector<CouplingKey> rows{
      {.key = "measure", .has = [](const F& f) { return f.has_measure; },
       .useless = "is a key of torsional couplings"},
      {.key = "point", .has = [](const F& f) { return f.at_point; },
       .useless = "this type of coupling has no point", .unit = "m"},
      {.key = "damper", .has = [](const F& f) { return has_springs(f) && !f.printed; },
       .useless = "this type of coupling has its own damper, or none"},
      {.key = "stiffness", .has = has_springs, .useless = kNoGain,
       .unit = "N/m", .turning_unit = "N m/rad", .number = at<&C::stiffness>, .added = 1000,
       .slider = {"stiffness k", 1, 1e7, "Coupling force per position error to the target robot; "
                  "torque per angle for torsional couplings."},
       .turning_low = 0.01, .turning_high = 1e6},
      {.key = "damping", .has = has_springs, .useless = kNoGain,
       .unit = "N s/m", .turning_unit = "N m s/rad", .number = at<&C::damping>,
       .slider = {"damping b", 0.01, 1e5, "Coupling force per velocity error; torque per angular "
                  "velocity for torsional couplings."},
       .turning_low = 1e-4, .turning_high = 1e4},
      {.key = "rotational_stiffness", .has = has<Gains::two_springs>, .useless = "is a key of bushings",
       .unit = "N m/rad", .number = at<&C::rotational_stiffness>,
       .added = 0.01, .added_times = "stiffness",  // a lever arm of 0.1 m
       .slider = {"rotational stiffness", 0.01, 1e5, "Torque per orientation error."}},
      {.key = "rotational_damping", .has = has<Gains::two_springs>, .useless = "is a key of bushings",
       .unit = "N m s/rad", .number = at<&C::rotational_damping>,
       .slider = {"rotational damping", 1e-4, 1e4, "Torque per angular velocity error."}},
      {.key = "time_constant", .has = has<Gains::reference>, .useless = "is a key of welds",
       .unit = "s", .range = kPositive, .number = at<&C::reference, &W::time_constant>,
       .slider = {"time constant", 1e-3, 1, "MuJoCo solref: time constant of the tracking error."}},
      {.key = "damping_ratio", .has = has<Gains::reference>, .useless = "is a key of welds",
       .range = kPositive, .number = at<&C::reference, &W::damping_ratio>,
       .slider = {"damping ratio", 0.05, 10, "MuJoCo solref; 1 is critically damped."}},
      {.key = "impedance", .has = has<Gains::reference>, .useless = "is a key of welds",
       .range = {Sign::positive, [](double d) { return d < 1; },
                 "must be below 1: at 1 the weld would be rigid",
                 "give a number between 0 and 1, or a [[constraint]] of type \"weld\""},
       .number = at<&C::reference, &W::impedance>,
       .slider = {"impedance", 0.05, 0.999, "MuJoCo impedance d; 1 would be a rigid weld.",
                  SliderRow::linear}},
      {.key = "rate", .has = [](const F& f) { return f.can_hold; },
       .useless = "this type of coupling is computed at every step",
       .unit = "Hz", .range = kPositive, .number = at<&C::rate>,
       .slider = {.meaning = "Rate of evaluation; the force is held in between, explicit."}},
      {.key = "discretization", .has = [](const F& f) { return f.discretizations == F::Discretizations::all; },
       .useless = "this type of coupling has its own discretization"},
      {.key = "link", .has = [](const F& f) { return f.gains != Gains::none; },
       .useless = "a god object moves all joints"},
      {.key = "soft_limits", .has = [](const F& f) { return f.has_measure; }},
      {.key = "delay", .has = any_coupling,
       .useless = "needs a moving target",
       .unit = "s", .number = at<&C::delay>,
       .slider = {.meaning = "Delay of the target's motion."},
       .of_target = CouplingTarget::is_operator, .help = "leave it out, or give a moving target"},
      {.key = "speed", .has = any_coupling,
       .useless = "needs a target that is a named motion or a trace",
       .range = kPositive, .number = at<&C::speed>,
       .slider = {"speed of the motion", 0.1, 10,
                  "Factor on the speed of the target's motion.", SliderRow::log, true},
       .of_target = is_played,
       .help = "leave it out, or give target = \"paper\" or a trace file"}};
  // clang-format on
  return rows;
}

const CouplingKey& coupling_key(const std::string& key) {
  const auto& rows = coupling_keys();
  return *std::ranges::find(rows, key, &CouplingKey::key);
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

// ---- ranges and units ----

std::optional<double> read_number(TableReader& table, const char* key, const NumberRange& range) {
  const auto value = range.sign == Sign::positive       ? table.positive(key)
                     : range.sign == Sign::not_negative ? table.not_negative(key)
                                                        : table.number(key);
  if (value && range.fits && !range.fits(*value))
    table.fault(key, range.problem, range.fix, "scene.range");
  return value;
}

std::string unit_of_number(const Value& scene, const std::string& text) {
  Value copy = scene;
  const ValuePath path(text);
  DiagnosticList ignored;
  const auto found =
      attempt(ignored, [&] { return find_targets(copy, path, MadeKeys::last, 0, text); });
  if (!found) return "";
  const std::string& key = path.parts.back().name;
  if (path.parts.size() > 1 && path.parts.front().name == "coupling")
    for (const CouplingKey& row : coupling_keys()) {
      if (key != row.key) continue;
      const bool is_torsional = is_torsional_table(*found->front().table);
      const bool agree = std::ranges::all_of(*found, [&](const PathTarget& target) {
        return is_torsional_table(*target.table) == is_torsional;
      });
      return row.turning_unit && !agree ? "" : row.unit_of(is_torsional);
    }
  for (const SurfaceKey& row : surface_keys())
    if (key == row.key) return row.unit;
  for (const auto& [name, unit] : kOtherUnits)
    if (key == name) return unit;
  std::string unit;
  for_each_shape([&](const auto& shape) {
    if constexpr (requires { shape.lengths(); })
      for_each_length(shape, [&](const char* length, const auto&) {
        if (key == length) unit = "m";
      });
  });
  return unit;
}

// ---- tables for the reference ----

std::string scene_numbers() {
  constexpr const char* kHead =
      "| key | of | unit | default | range | meaning |\n|---|---|---|---|---|---|\n";
  std::string page = kHead;
  for (const SurfaceKey& row : surface_keys())
    page += to_markdown({row.key, row.of_pair ? "robot, body, pair" : "robot, body", row.unit,
                         ContactSurface().*row.member, row.range, row.slider.meaning});
  page += std::string("\n") + kHead;
  for (const CouplingKey& row : coupling_keys()) {
    if (!row.number) continue;
    std::string of;
    for (const CouplingFacts& facts : all_couplings)
      if (row.has(facts)) of += (of.empty() ? "" : ", ") + std::string(facts.name);
    const double value = row.value({});
    const bool is_given = value > 0 || row.range.sign != Sign::positive;
    std::string unit = row.unit;
    if (row.turning_unit) unit += std::string(" or ") + row.turning_unit;
    page += to_markdown({row.key, of, unit.c_str(),
                         is_given && !row.is_required() ? std::optional(value) : std::nullopt,
                         row.range, row.slider.meaning});
  }
  return page;
}

}  // namespace twinarm
