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
  explicit Watch(const std::vector<const AnalyticCase*>& cases) : cases_(cases) {}
  void operator()(std::size_t next) {
    using Clock = std::chrono::steady_clock;
    check_interrupt();
    const auto count = static_cast<double>(cases_.size());
    if (!bar_ && Clock::now() - start_ > std::chrono::seconds(2)) {
      bar_.emplace(isatty(STDERR_FILENO) == 0);
      bar_->stage("compare", static_cast<double>(next) / count);
    }
    if (bar_ && next < cases_.size()) bar_->stage(cases_[next]->name, 1 / count);
  }

 private:
  const std::vector<const AnalyticCase*>& cases_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<Progress> bar_;
};

}  // namespace

int run_compare(const CompareOptions& options) {
  constexpr int kFellShort = 1;
  const std::vector<const AnalyticCase*> cases = select_cases(options.cases, options.group);
  std::vector<CompareRow> rows;
  {
    Watch watch(cases);
    rows = run_cases(cases, [&](std::size_t next) { watch(next); });
  }
  fmt::print("{}", options.json ? compare_json(rows) : compare_table(rows));
  return failures(rows) == 0 ? 0 : kFellShort;
}

}  // namespace twinarm
