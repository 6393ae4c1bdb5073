#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <optional>

#include "app/command/commands.h"
#include "app/compare/compare.h"
#include "app/compare/page/page.h"
#include "app/support/interrupt.h"
#include "app/support/output_file.h"
#include "app/support/progress.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

// A bar for those who have waited for two seconds; Ctrl-C is noticed between two cases.
class Watch {
 public:
  // `name` is run, `share` of all the work is done.
  void operator()(const char* name, double share) {
    check_interrupt();
    if (!bar_ && seconds() < 2) return;
    if (!bar_) bar_.emplace(isatty(STDERR_FILENO) == 0);
    if (share > told_) bar_->stage(name, share - told_);
    told_ = std::max(told_, share);
    bar_->advance(1);
  }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  double told_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<Progress> bar_;
};

// Runs all cases. Until they have run nobody knows which take long: each counts alike.
std::vector<CompareRow> run_all(const CaseSelection& selection, const std::vector<Lane>& lanes,
                                Watch& watch, double share) {
  const std::size_t count = selection.cases.size();
  std::vector<CompareRow> rows(count);
  two_at_a_time(
      count, [&](std::size_t i) { rows[i] = run_one(*selection.cases[i], lanes); },
      [&](std::size_t done) {
        if (done < count)
          watch(selection.cases[done]->name,
                share * static_cast<double>(done) / static_cast<double>(count));
      });
  return rows;
}

// The sections of the page, in the order of the rows. Those that take long are made first, so that
// both threads end together.
std::vector<std::string> make_sections(const std::vector<CompareRow>& rows,
                                       const std::vector<Lane>& lanes, Watch& watch, double share) {
  constexpr double kDrawing = 0.1;  // [s], beside what a case takes
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rows[a].seconds > rows[b].seconds; });
  std::vector<double> before{0};  // the work of the first n
  for (const std::size_t i : order) before.push_back(before.back() + rows[i].seconds + kDrawing);
  std::vector<std::string> sections(rows.size());
  two_at_a_time(
      rows.size(),
      [&](std::size_t i) {
        sections[order[i]] = compare_page::case_section(rows[order[i]], lanes);
      },
      [&](std::size_t done) {
        if (done < order.size())
          watch(rows[order[done]].test->name, 1 - share + share * before[done] / before.back());
      });
  return sections;
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

// As it could be typed again.
std::string command_line(const CompareOptions& options) {
  std::string line = "twinarm compare";
  for (const std::string& name : options.cases) line += " " + name;
  if (!options.group.empty()) line += " --group " + options.group;
  if (!options.integrators.empty()) line += " --integrator " + joined(options.integrators, ",");
  std::vector<std::string> steps;
  for (const double step : options.steps) steps.push_back(fmt::format("{:g}", step));
  if (!steps.empty()) line += " --step " + joined(steps, ",");
  return line + " --html " + options.html.string();
}

}  // namespace

int run_compare(const CompareOptions& options) {
  constexpr int kFellShort = 1;
  FaultList faults;
  const CaseSelection selection = select_cases(options.cases, options.group, faults);
  const std::vector<Lane> lanes = read_lanes(options.integrators, options.steps, faults);
  std::filesystem::path page;
  if (!options.html.empty()) {
    page = compare_page::page_file(options.html);
    compare_page::check_page(page, faults);
  }
  faults.check();

  constexpr double kPageShare = 0.75;  // of the work, as it was measured
  std::vector<CompareRow> rows;
  {
    Watch watch;
    rows = run_all(selection, lanes, watch, page.empty() ? 1 : 1 - kPageShare);
    if (!page.empty()) {
      const auto sections = make_sections(rows, lanes, watch, kPageShare);
      make_folder(std::filesystem::absolute(page).parent_path(), "--html");
      write_whole_file(page, compare_page::page_html(rows, sections, selection.skipped,
                                                     command_line(options), watch.seconds()));
    }
  }
  if (options.json) {
    fmt::print("{}", compare_json(rows, lanes, selection.skipped, page.string()));
  } else {
    fmt::print("{}", compare_table(rows, lanes, selection.skipped));
    if (!page.empty()) fmt::print("page: {}\n", page.string());
  }
  return failures(rows) == 0 ? 0 : kFellShort;
}

}  // namespace twinarm
