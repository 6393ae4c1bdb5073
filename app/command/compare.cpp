// `twinarm compare`.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <numeric>

#include "app/command/command.h"
#include "app/command/parser/shared_options.h"
#include "app/compare/compare.h"
#include "app/compare/page/page.h"
#include "app/support/files.h"
#include "app/support/parallel_for.h"
#include "app/support/progress.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

struct CompareOptions {
  std::vector<std::string> cases;
  std::string group;
  std::vector<std::string> integrators;
  std::vector<double> steps;
  std::filesystem::path html;  // folder or .html file of the page; empty: none
  bool json = false;
};

void add_options(CLI::App& command, CompareOptions& options) {
  command.add_option("case", options.cases,
                     "names; E1 also means E1-.., E all of E, joints that group; all if not given");
  command.add_option("--group", options.group, "all cases of this group");
  command
      .add_option("--integrator", options.integrators,
                  "run known motions with these beside: name,name,..; of" + integrator_names())
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--step", options.steps, "and with these steps: h1,h2,.. [s]")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_file_option(command, "--html", options.html,
                  "folder for the page compare.html: statements, figures, code of all cases");
  add_json_option(command, options.json);
}

// Runs all cases. Until they have run nobody knows which take long: each counts alike.
std::vector<CompareRow> run_all(const CaseSelection& selection, const std::vector<Lane>& lanes,
                                Progress& progress, double share) {
  const std::size_t count = selection.cases.size();
  std::vector<CompareRow> rows(count);
  parallel_for(
      count, [&](std::size_t i) { rows[i] = run_one(*selection.cases[i], lanes); },
      [&](std::size_t done) {
        check_interrupt();
        if (done < count)
          progress.at(selection.cases[done]->name,
                      share * static_cast<double>(done) / static_cast<double>(count));
      });
  return rows;
}

// The sections of the page, in the order of the rows. Those that take long are made first, so that
// all threads end together.
std::vector<std::string> make_sections(const std::vector<CompareRow>& rows,
                                       const std::vector<Lane>& lanes, Progress& progress,
                                       double share) {
  constexpr double kDrawing = 0.1;  // [s], beside what a case takes
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return rows[a].seconds > rows[b].seconds; });
  std::vector<double> before{0};  // the work of the first n
  for (const std::size_t i : order) before.push_back(before.back() + rows[i].seconds + kDrawing);
  std::vector<std::string> sections(rows.size());
  parallel_for(
      rows.size(),
      [&](std::size_t i) {
        sections[order[i]] = compare_page::case_section(rows[order[i]], lanes);
      },
      [&](std::size_t done) {
        check_interrupt();
        if (done < order.size())
          progress.at(rows[order[done]].test->name,
                      1 - share + share * before[done] / before.back());
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

int run_compare(const CompareOptions& options) {
  constexpr int kFellShort = 1;
  DiagnosticList faults;
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
    Progress progress(false, Progress::kPatience);
    rows = run_all(selection, lanes, progress, page.empty() ? 1 : 1 - kPageShare);
    if (!page.empty()) {
      const auto sections = make_sections(rows, lanes, progress, kPageShare);
      make_folder(std::filesystem::absolute(page).parent_path(), "--html");
      write_whole_file(page, compare_page::page_html(rows, sections, selection.skipped,
                                                     command_line(options), progress.seconds()));
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

}  // namespace

Command compare_command() {
  return {120, "compare",
          "Run cases whose outcome is known, and tell how far off this solver is\n\n"
          "Example:  twinarm compare A1 B --integrator rk4,verlet --step 0.001,0.002",
          add_options, run_compare};
}

}  // namespace twinarm
