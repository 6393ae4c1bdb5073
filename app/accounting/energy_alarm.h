// Says when something creates energy without bound: a run that will explode says so before it does.
//
// Looked at are the rows of what no law of nature does: `numerical`, what implicit treatments of
// couplings do besides their springs, and what stabilises constraints and contacts. In a sound run
// they stay small; an instability grows by a factor in each length of time. So an alarm is a row
// that over four windows of equal length grew, from window to window by half as much again at
// least, and now exceeds
//   - the largest kinetic energy before those windows, and what the weight is worth over 1e-6 m,
//   - a quarter of the largest kinetic energy so far.
// A run where that holds has lost count of its energy. Windows have 16 steps, 32, 64 and so on, so
// that slow growth is seen too. What bursts within one window of 16 steps and may be over after it
// is a row that grew by more than ten times the largest kinetic energy before (and ten times what
// the weight is worth over 1 mm), to more than half of the largest so far. Losses are bounded, and
// never alarm.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/accounting/energy_balance.h"

namespace twinarm {

struct Alarm {
  std::string row;   // of the ledger
  double t = 0;      // [s]
  double work = 0;   // [J]
  double since = 0;  // its windows began then [s]
};

class LedgerAlarm {
 public:
  static constexpr long kWindow = 16;  // steps

  explicit LedgerAlarm(double weight) : floor_(1e-6 * weight) {}
  // After every kWindow steps; the first that alarms, once in all.
  std::optional<Alarm> look(double t, double kinetic, const std::vector<LedgerRow>& rows);

 private:
  static constexpr std::size_t kScales = 16, kMarks = 5;
  static constexpr long kCoarser = 2;
  struct Mark {
    double t = 0, largest_kinetic = 0;
    std::vector<LedgerRow> rows;
  };
  struct Scale {
    std::array<Mark, kMarks> marks;  // the last one is the newest
    std::size_t count = 0;
  };
  std::optional<Alarm> burst(const Scale& finest) const;
  std::optional<Alarm> examine(const Scale& scale) const;

  double floor_, largest_kinetic_ = 0;
  long count_ = 0;
  bool is_told_ = false;
  std::array<Scale, kScales> scales_;
};

}  // namespace twinarm
