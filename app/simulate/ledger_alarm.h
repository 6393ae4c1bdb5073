// Says when something creates energy without bound: a run that will explode says so before it does.
//
// Looked at are `numerical`, what each coupling gives to the bodies beyond the work of its hand,
// and what stabilises constraints and contacts. What is physical is bounded by what was there or
// was put in; an instability grows by a factor in each length of time. So an alarm is a quantity
// that over four windows of equal length grew, from window to window by half as much again at
// least, and now exceeds
//   - the largest kinetic energy before those windows, and what the weight is worth over 1e-6 m,
//   - a quarter of the largest kinetic energy so far.
// The second alone is met by no sound run: it has lost count of its energy. Windows have 16 steps,
// 32, 64 and so on, so that slow growth is seen too. Losses are bounded, and never alarm.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/simulate/ledger.h"

namespace twinarm {

struct Alarm {
  std::string row;   // of the ledger; of a coupling without the part
  double t = 0;      // [s]
  double work = 0;   // [J]
  double since = 0;  // the four windows began then [s]
};

class LedgerAlarm {
 public:
  static constexpr long kWindow = 16;  // steps

  explicit LedgerAlarm(double weight) : floor_(1e-6 * weight) {}
  // After every kWindow steps; the first that alarms, once in all.
  std::optional<Alarm> look(double t, double kinetic, const std::vector<LedgerRow>& rows,
                            const std::vector<LedgerRow>& hand);

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
  std::optional<Alarm> examine(const Scale& scale) const;

  double floor_, largest_kinetic_ = 0;
  long count_ = 0;
  bool is_told_ = false;
  std::array<Scale, kScales> scales_;
};

}  // namespace twinarm
