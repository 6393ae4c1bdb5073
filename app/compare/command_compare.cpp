#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <optional>

#include "app/commands.h"
#include "app/compare/compare.h"
#include "app/interrupt.h"
#include "app/progress.h"

namespace twinarm {
namespace {

// A bar for those who have waited for two seconds; Ctrl-C is noticed between two cases.
class Watch {
 public:
  explicit Watch(std::size_t count) : count_(static_cast<double>(count)) {}
  void operator()(std::size_t done, const char* name) {
    using Clock = std::chrono::steady_clock;
    check_interrupt();
    if (!bar_ && Clock::now() - start_ > std::chrono::seconds(2)) {
      bar_.emplace(isatty(STDERR_FILENO) == 0);
      bar_->stage("compare", static_cast<double>(done) / count_);
      told_ = done;
    }
    for (; bar_ && told_ < done; ++told_) bar_->stage(name, 1 / count_);
  }

 private:
  double count_;
  std::size_t told_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<Progress> bar_;
};

}  // namespace

int run_compare(const CompareOptions& options) {
  constexpr int kFellShort = 1;
  FaultList faults;
  const CaseSelection selection = select_cases(options.cases, options.group, faults);
  const std::vector<Lane> lanes = read_lanes(options.integrators, options.steps, faults);
  faults.check();
  std::vector<CompareRow> rows;
  {
    Watch watch(selection.cases.size());
    rows = run_cases(selection.cases, lanes,
                     [&](std::size_t done, const char* name) { watch(done, name); });
  }
  fmt::print("{}", options.json ? compare_json(rows, lanes, selection.skipped)
                                : compare_table(rows, lanes, selection.skipped));
  return failures(rows) == 0 ? 0 : kFellShort;
}

}  // namespace twinarm
