// Alarm on rows of the energy balance that grow exponentially; the criteria stand in the header.
#include "app/accounting/energy_balance.h"

namespace twinarm {
namespace {

constexpr double kGrowth = 1.5, kShare = 0.25;
constexpr double kBurst = 10, kBurstShare = 0.5, kBurstHeight = 1e3;  // relative to floor_

std::vector<EnergyRow> numerical_rows(const std::vector<EnergyRow>& rows) {
  std::vector<EnergyRow> found;
  for (const EnergyRow& row : rows) switch (row.kind) {
      case EnergyRowKind::numerical:
      case EnergyRowKind::coupling_implicit:
      case EnergyRowKind::constraint_stabilisation:
      case EnergyRowKind::contact_stabilisation:
      case EnergyRowKind::limit_stabilisation:
        found.push_back(row);
        break;
      default:
        break;
    }
  return found;
}

double work_of(const std::vector<EnergyRow>& rows, const std::string& name) {
  for (const EnergyRow& row : rows)
    if (row.name == name) return row.work;
  return 0;
}

}  // namespace

std::optional<Alarm> EnergyAlarm::look(double t, double kinetic,
                                       const std::vector<EnergyRow>& rows) {
  if (has_alarmed_) return std::nullopt;
  max_kinetic_ = std::max(max_kinetic_, kinetic);
  const std::vector<EnergyRow> now = numerical_rows(rows);
  long every = 1;
  for (Scale& scale : scales_) {
    if (count_ % every != 0) break;
    std::rotate(scale.marks.begin(), scale.marks.begin() + 1, scale.marks.end());
    scale.marks.back() = {t, max_kinetic_, now};
    ++scale.count;
    std::optional<Alarm> alarm;
    if (scale.count >= 2 && every == 1) alarm = burst(scale);
    if (!alarm && scale.count >= kMarks) alarm = examine(scale);
    if (alarm) {
      has_alarmed_ = true;
      return alarm;
    }
    every *= kCoarser;
  }
  ++count_;
  return std::nullopt;
}

std::optional<Alarm> EnergyAlarm::burst(const Scale& scale) const {
  const Mark &before = scale.marks[kMarks - 2], &now = scale.marks.back();
  const double reference = std::max(before.max_kinetic, kBurstHeight * floor_);
  for (const EnergyRow& row : now.rows)
    if (row.work - work_of(before.rows, row.name) > kBurst * reference &&
        row.work > kBurstShare * now.max_kinetic)
      return Alarm{row.name, now.t, row.work, before.t};
  return std::nullopt;
}

std::optional<Alarm> EnergyAlarm::examine(const Scale& scale) const {
  const Mark &first = scale.marks.front(), &last = scale.marks.back();
  const double threshold = std::max({floor_, first.max_kinetic, kShare * last.max_kinetic});
  for (const EnergyRow& row : last.rows) {
    if (!(row.work > threshold)) continue;
    bool grows = true;
    double growth = 0;
    for (std::size_t m = 1; m < kMarks; ++m) {
      const double then =
          work_of(scale.marks[m].rows, row.name) - work_of(scale.marks[m - 1].rows, row.name);
      grows = grows && then > 0 && then >= kGrowth * growth;
      growth = then;
    }
    if (grows) return Alarm{row.name, last.t, row.work, first.t};
  }
  return std::nullopt;
}

}  // namespace twinarm
