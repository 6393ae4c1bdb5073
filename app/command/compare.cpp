#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <thread>

#include "app/command/command.h"
#include "app/compare/compare.h"
#include "app/compare/page/page.h"
#include "app/page/pages.h"
#include "app/plot/gnuplot.h"
#include "app/support/files.h"
#include "app/support/parallel_for.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

struct CompareOptions {
  std::vector<std::string> cases;
  std::string group;
  std::vector<std::string> integrators;
  std::vector<double> steps;
  std::filesystem::path html;  // folder or .html file; empty: no page
  bool json = false;
};

void add_options(const OptionAdder& add, CompareOptions& options) {
  add.group("Cases");
  add("case", options.cases,
      "cases by name or prefix (E1 runs E1 and all E1-.., E all of E), or by group; default: all, "
      "about 30 s");
  add("--group", options.group, "run all cases of this group");
  add.group("Run");
  add("--integrator", options.integrators,
      "also run cases with a known motion with these integrators: NAME,..; of: " +
          integrator_names())
      ->delimiter(',')
      ->allow_extra_args(false);
  add("--step", options.steps, "also run them with these steps: h1,h2,.. [s]")
      ->delimiter(',')
      ->allow_extra_args(false);
  add.group("Output");
  add.output("--html", options.html, "",
             "write the page compare.html into this folder: statements, figures, code");
  add.json(options.json);
}

// From measured means of the groups on one processor [s].
double expected_seconds(const CaseSelection& selection) {
  std::map<std::string, double> more{
      {"loops", 1.2}, {"engines", 1.2}, {"contact", 0.2}, {"couplings", 0.2}};
  double sum = 0;
  for (const AnalyticCase* test : selection.cases) sum += 0.04 + more[test->group];
  return sum / std::max(1U, std::thread::hardware_concurrency());
}

// make(i) of all cases. Their durations are not known before: each counts equally in the part of
// the progress bar that ends at `end`.
template <class Make>
auto for_cases(const CaseSelection& selection, Progress& progress, double begin, double end,
               Make make) {
  const std::size_t count = selection.cases.size();
  std::vector<decltype(make(0))> made(count);
  parallel_for(
      count, [&](std::size_t i) { made[i] = make(i); },
      [&](std::size_t done) {
        check_interrupt();
        const double share = static_cast<double>(done) / static_cast<double>(count);
        if (done < count) progress.at(selection.cases[done]->name, begin + share * (end - begin));
      });
  return made;
}

int run_compare(const CompareOptions& options, const Words& typed) {
  constexpr int kFailed = 1;
  DiagnosticList faults;
  const CaseSelection selection = select_cases(options.cases, options.group, faults);
  const std::vector<Integration> integrations =
      read_integrations(options.integrators, options.steps, faults);
  std::filesystem::path page;
  if (!options.html.empty()) {
    page = compare_page::page_file(options.html);
    check_place(page, "--html", faults);
    attempt(faults, require_gnuplot);
  }
  faults.check();

  constexpr double kPageShare = 0.75;  // of the duration, measured
  const double run_share = page.empty() ? 1 : 1 - kPageShare;
  std::vector<CompareRow> rows;
  if (!options.json)
    print_error("twinarm: cases: {}, about {:.0f} s\n", selection.cases.size(),
                std::ceil(expected_seconds(selection) / run_share));
  {
    Progress progress(false, Progress::kPatience);
    rows = for_cases(selection, progress, 0, run_share,
                     [&](std::size_t i) { return run_one(*selection.cases[i], integrations); });
    if (!page.empty()) {
      const auto sections = for_cases(selection, progress, run_share, 1, [&](std::size_t i) {
        return compare_page::case_section(rows[i], integrations);
      });
      write_whole_file(page, compare_page::page_html(rows, sections, selection.skipped,
                                                     command_line(typed), progress.seconds()));
    }
  }
  if (options.json) {
    fmt::print("{}", compare_json(rows, integrations, selection.skipped, page.string()));
  } else {
    fmt::print("{}", compare_table(rows, integrations, selection.skipped));
    print_wrote({page}, false);
  }
  return failures(rows) == 0 ? 0 : kFailed;
}

}  // namespace

Command compare_command() {
  return {120, "compare",
          "Run the analytic test cases and report the errors of the solver\n\n"
          "Examples:\n"
          "  twinarm compare --html out/compare\n"
          "  twinarm compare A1 B --integrator rk4,verlet --step 0.001,0.002",
          add_options, run_compare};
}

}  // namespace twinarm
