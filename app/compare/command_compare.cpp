#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "app/commands.h"
#include "app/compare/compare.h"
#include "app/compare/page.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "solver/whole_file.h"

namespace twinarm {
namespace {

// A bar for those who have waited for two seconds; Ctrl-C is noticed between two cases.
class Watch {
 public:
  explicit Watch(std::size_t count) : count_(static_cast<double>(count)) {}
  void operator()(const char* name, std::size_t done) {
    using Clock = std::chrono::steady_clock;
    check_interrupt();
    if (!bar_ && Clock::now() - start_ > std::chrono::seconds(2)) {
      bar_.emplace(isatty(STDERR_FILENO) == 0);
      bar_->stage(name, static_cast<double>(done) / count_);
      told_ = done;
    }
    for (; bar_ && told_ < done; ++told_) bar_->stage(name, 1 / count_);
  }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  double count_;
  std::size_t told_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<Progress> bar_;
};

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

  const std::size_t count = selection.cases.size();
  std::vector<CompareRow> rows(count);
  {
    Watch watch(page.empty() ? count : 2 * count);
    const auto name_of = [&](std::size_t i) {
      return count == 0 ? "" : selection.cases[std::min(i, count - 1)]->name;
    };
    two_at_a_time(
        count, [&](std::size_t i) { rows[i] = run_one(*selection.cases[i], lanes); },
        [&](std::size_t done) { watch(name_of(done), done); });
    if (!page.empty()) {
      std::vector<std::string> sections(count);
      two_at_a_time(
          count, [&](std::size_t i) { sections[i] = compare_page::case_section(rows[i], lanes); },
          [&](std::size_t done) { watch(name_of(done), count + done); });
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
