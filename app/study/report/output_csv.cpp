#include "app/study/report/output_csv.h"

#include <fmt/format.h>

#include <numbers>

#include "app/support/output_file.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

struct Column {
  std::string header;
  const std::vector<double>* values;
};

std::string csv(const std::vector<Column>& columns) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (std::size_t c = 0; c < columns.size(); ++c)
    fmt::format_to(out, "{}{}", columns[c].header, c + 1 == columns.size() ? '\n' : ',');
  const std::size_t rows = columns.front().values->size();
  for (std::size_t n = 0; n < rows; ++n)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::vector<double>& values = *columns[c].values;
      if (n < values.size()) fmt::format_to(out, "{}", values[n]);  // else an empty field
      text.push_back(c + 1 == columns.size() ? '\n' : ',');
    }
  return fmt::to_string(text);
}

std::string file_name(std::string name) {
  for (char& c : name)
    if (c == '/' || c == '\\' || c == ' ') c = '_';
  return name + ".csv";
}

std::string run_csv(const RunResult& run) {
  const TrackingSeries& series = run.series;
  const char* pull_unit = run.spec.coupling.type == CouplingSpec::Type::linear ? "N" : "N m";
  std::vector<Column> columns{{"t[s]", &series.t}};
  const auto add = [&](const char* name, const std::vector<std::vector<double>>& values,
                       const char* unit) {
    for (std::size_t j = 0; j < values.size(); ++j)
      columns.push_back({fmt::format("{}/joint{}[{}]", name, j + 1, unit), &values[j]});
  };
  add("q_K", series.q_K, "rad");
  add("q_D", series.q_D, "rad");
  add("pull", series.pull, pull_unit);
  return csv(columns);
}

std::string obstacle_csv(const ObstacleRun& run) {
  std::vector<double> angles[4];
  for (std::size_t n = 0; n < run.t.size(); ++n)
    for (std::size_t j = 0; j < 2; ++j) {
      if (n < run.q_K_deg.size()) angles[j].push_back(run.q_K_deg[n][j] * std::numbers::pi / 180);
      if (n < run.q_D_deg.size())
        angles[2 + j].push_back(run.q_D_deg[n][j] * std::numbers::pi / 180);
    }
  return csv({{"t[s]", &run.t},
              {"q_K/joint1[rad]", &angles[0]},
              {"q_K/joint2[rad]", &angles[1]},
              {"q_D/joint1[rad]", &angles[2]},
              {"q_D/joint2[rad]", &angles[3]},
              {fmt::format("pull[{}]", run.pull_unit), &run.pull},
              {"contact_force[N]", &run.contact_force},
              {"penetration[m]", &run.penetration},
              {"beyond[m]", &run.beyond}});
}

}  // namespace

void write_csv(const StudyResults& results, const std::filesystem::path& folder) {
  for (const auto* runs : {&results.reproduction, &results.variants})
    for (const RunResult& run : *runs)
      write_whole_file(folder / file_name(run.spec.name), run_csv(run));
  for (const ObstacleRun& run : results.obstacle)
    write_whole_file(folder / file_name("obstacle_" + run.name), obstacle_csv(run));
}

}  // namespace twinarm
