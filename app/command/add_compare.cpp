// The options of `twinarm compare`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_compare(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* compare = app.add_subcommand(
      "compare",
      "Run cases whose outcome is known, and tell how far off this solver is\n\n"
      "Example:  twinarm compare A1 B --integrator rk4,verlet --step 0.001,0.002");
  compare->add_option(
      "case", options->cases,
      "names; E1 also means E1-.., E all of E, joints that group; all if not given");
  std::string names;
  for (const IntegratorFacts& facts : all_integrators) names += std::string(" ") + facts.name;
  compare->add_option("--group", options->group, "all cases of this group");
  compare
      ->add_option("--integrator", options->integrators,
                   "run known motions with these beside: name,name,..; of" + names)
      ->delimiter(',')
      ->allow_extra_args(false);
  compare->add_option("--step", options->steps, "and with these steps: h1,h2,.. [s]")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_file_option(*compare, "--html", options->html,
                  "folder for the page compare.html: statements, figures, code of all cases");
  compare->add_flag("--json", options->json, "print one JSON object on stdout");
  compare->callback(
      [options, &line] { line.chosen = [options] { return run_compare(*options); }; });
}

}  // namespace twinarm
