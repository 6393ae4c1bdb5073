#include <fmt/format.h>

#include <sstream>

#include "app/data/json_writer.h"
#include "app/data/tables.h"
#include "app/support/files.h"
#include "app/support/text.h"
#include "app/trial/trial.h"
#include "solver/support/atomic_file.h"
#include "solver/support/input_file.h"

namespace twinarm {
namespace {

const std::string kTrialHeader =
    "participant,order,condition,task,device,mapping,done,seconds,picks,drops,off[mm],joint1_max["
    "deg],joint1_mean[deg],joint2_max[deg],joint2_mean[deg]\n";

std::string csv_row(const TrialReport& report, std::size_t order) {
  const TrialResult& r = report.results[order];
  std::string row =
      fmt::format("{},{},{},{},{},{},{},{:.3f},{},{},{:.1f}", csv_field(report.participant),
                  order + 1, r.condition, r.task, csv_field(report.device), report.mapping,
                  r.is_done ? 1 : 0, r.seconds, r.picks, r.drops, r.placement_error_mm);
  for (std::size_t j = 0; j < 2; ++j)
    row += j < r.max_deg.size() ? fmt::format(",{:.4f},{:.4f}", r.max_deg[j], r.mean_deg[j]) : ",,";
  return row + "\n";
}

std::string old_rows(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return kTrialHeader;
  const std::string text = read_whole_file(file);
  if (!text.starts_with(kTrialHeader))
    throw InputError({{file.string(), 1, "header", "not a results table of twinarm trial",
                       "give another folder with --out", "trial.header"}});
  return text;
}

}  // namespace

std::string trial_table(const TrialReport& report) {
  TextTable table({"condition, task", "time [s]", "done", "picks, drops", "distance [mm]",
                   "joint1 max [deg]", "mean", "joint2 max [deg]", "mean"});
  for (const TrialResult& r : report.results) {
    const bool picks = r.task != "free";
    std::vector<std::string> row{r.condition + ", " + r.task, fmt::format("{:.2f}", r.seconds),
                                 r.is_done ? "yes" : "no",
                                 picks ? fmt::format("{}, {}", r.picks, r.drops) : "-",
                                 picks ? fmt::format("{:.0f}", r.placement_error_mm) : "-"};
    for (std::size_t j = 0; j < 2; ++j) {
      const bool has = j < r.max_deg.size();
      row.push_back(has ? fmt::format("{:.2f}", r.max_deg[j]) : "-");
      row.push_back(has ? fmt::format("{:.2f}", r.mean_deg[j]) : "-");
    }
    table.add(row);
  }
  return fmt::format("participant {}, {}, mapping {}\n\n{}", report.participant, report.device,
                     report.mapping, table.str());
}

std::string trial_json(const TrialReport& report) {
  return answer_text([&](JsonWriter& json) {
    const auto write_result = [&](const TrialResult& r) {
      json.object({{"condition", r.condition},
                   {"task", r.task},
                   {"done", r.is_done},
                   {"seconds", r.seconds},
                   {"picks", r.picks},
                   {"drops", r.drops},
                   {"picked_at", r.picked_at < 0 ? std::nullopt : std::optional(r.picked_at)},
                   {"placement_error_mm", r.placement_error_mm},
                   {"max_deg", r.max_deg},
                   {"mean_deg", r.mean_deg},
                   {"log", r.log}});
    };
    json.members({{"participant", report.participant},
                  {"device", report.device},
                  {"mapping", report.mapping},
                  {"results", [&] { json.list(report.results, write_result); }},
                  {"csv", report.csv}});
  });
}

void add_last_to_csv(const TrialReport& report, const std::filesystem::path& file) {
  write_whole_file(file, old_rows(file) + csv_row(report, report.results.size() - 1));
}

std::string next_participant(const std::filesystem::path& file) {
  std::stringstream rows(old_rows(file));
  std::vector<std::string> known;
  for (std::string row; std::getline(rows, row);) known.push_back(row.substr(0, row.find(',')));
  for (int n = 1;; ++n) {
    const std::string code = fmt::format("S{}", n);
    if (std::ranges::find(known, code) == known.end()) return code;
  }
}

}  // namespace twinarm
