#include "app/command/export_page.h"

#include <fmt/format.h>

#include "app/data/json_writer.h"
#include "app/page/replay_page.h"
#include "app/support/output_file.h"
#include "solver/support/atomic_file.h"

namespace twinarm {

int export_page(const ExportOptions& options) {
  FaultList faults;
  if (options.csv)
    faults.add({"", 0, "--csv", "prints on stdout, and a page is asked for", "give one of them"});
  const std::string file = options.page.string(), end = options.page.extension().string();
  if (end != ".html" && end != ".htm")
    faults.add({file, 0, "", "is no name of a page", "let it end in .html"});
  check_place(options.page, faults);
  faults.check();

  const ReplayPage page = replay_page(options.recording);
  write_whole_file(options.page, page.html);
  if (!options.json) {
    fmt::print("wrote {}: {} frames, {:.3g} a second, {:.2f} MB\n", file, page.frames, page.rate,
               1e-6 * static_cast<double>(page.html.size()));
    return 0;
  }
  JsonWriter json;
  json.begin_object();
  json.key("file").text(file);
  json.key("frames").count(static_cast<long>(page.frames));
  json.key("rate").number(page.rate);
  json.key("bytes").count(static_cast<long>(page.html.size()));
  json.end_object();
  fmt::print("{}\n", json.str());
  return 0;
}

}  // namespace twinarm
