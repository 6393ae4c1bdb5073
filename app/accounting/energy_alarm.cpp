#include "app/accounting/energy_alarm.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace twinarm {
namespace {

constexpr double kGrowth = 1.5, kShare = 0.25;
constexpr double kBurst = 10, kBurstShare = 0.5, kBurstHeight = 1e3;  // of floor_'s 1e-6 m

// What an ideal element does is in none of these.
std::vector<LedgerRow> watched(const std::vector<LedgerRow>& rows) {
  std::vector<LedgerRow> found;
  for (const LedgerRow& row : rows) switch (row.kind) {
      case LedgerKind::numerical:
      case LedgerKind::coupling_implicit:
      case LedgerKind::constraint_stabilisation:
      case LedgerKind::contact_stabilisation:
      case LedgerKind::limit_stabilisation:
        found.push_back(row);
        break;
      default:
        break;
    }
  return found;
}

double work_of(const std::vector<LedgerRow>& rows, const std::string& name) {
  for (const LedgerRow& row : rows)
    if (row.name == name) return row.work;
  return 0;
}

}  // namespace

std::optional<Alarm> LedgerAlarm::look(double t, double kinetic,
                                       const std::vector<LedgerRow>& rows) {
  if (is_told_) return std::nullopt;
  largest_kinetic_ = std::max(largest_kinetic_, kinetic);
  const std::vector<LedgerRow> now = watched(rows);
  long every = 1;
  for (Scale& scale : scales_) {
    if (count_ % every != 0) break;
    std::rotate(scale.marks.begin(), scale.marks.begin() + 1, scale.marks.end());
    scale.marks.back() = {t, largest_kinetic_, now};
    ++scale.count;
    std::optional<Alarm> alarm;
    if (scale.count >= 2 && every == 1) alarm = burst(scale);
    if (!alarm && scale.count >= kMarks) alarm = examine(scale);
    if (alarm) {
      is_told_ = true;
      return alarm;
    }
    every *= kCoarser;
  }
  ++count_;
  return std::nullopt;
}

std::optional<Alarm> LedgerAlarm::burst(const Scale& scale) const {
  const Mark &before = scale.marks[kMarks - 2], &now = scale.marks.back();
  const double had = std::max(before.largest_kinetic, kBurstHeight * floor_);
  for (const LedgerRow& row : now.rows)
    if (row.work - work_of(before.rows, row.name) > kBurst * had &&
        row.work > kBurstShare * now.largest_kinetic)
      return Alarm{row.name, now.t, row.work, before.t};
  return std::nullopt;
}

std::optional<Alarm> LedgerAlarm::examine(const Scale& scale) const {
  const Mark &first = scale.marks.front(), &last = scale.marks.back();
  const double least = std::max({floor_, first.largest_kinetic, kShare * last.largest_kinetic});
  for (const LedgerRow& row : last.rows) {
    if (!(row.work > least)) continue;
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
