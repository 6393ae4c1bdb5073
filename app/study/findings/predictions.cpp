#include "app/study/findings/predictions.h"

#include <toml++/toml.h>

#include "collision/import/toml/toml_file.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

std::optional<std::array<double, 2>> pair_of(const toml::table& table, const char* key) {
  const auto* array = table[key].as_array();
  if (!array || array->size() != 2) return {};
  return std::array<double, 2>{array->get(0)->value_or(0.0), array->get(1)->value_or(0.0)};
}

}  // namespace

Predictions read_predictions(const std::filesystem::path& assets) {
  const std::filesystem::path file = assets / "study" / "predictions.toml";
  Predictions predictions;
  try {
    const toml::table root = toml::parse(read_toml_text(file), file.string());
    if (const auto* rows = root["row"].as_array())
      for (const auto& entry : *rows) {
        if (!entry.is_table()) continue;
        const toml::table& table = *entry.as_table();
        PredictedRow row{table["robot"].value_or(std::string()),
                         table["law"].value_or(std::string()), table["rate"].value_or(0.0),
                         pair_of(table, "max").value_or(std::array<double, 2>{}),
                         pair_of(table, "mean")};
        predictions.rows.push_back(row);
      }
    if (const auto* modes = root["modes"].as_array())
      for (const auto& entry : *modes) {
        if (!entry.is_table()) continue;
        const toml::table& table = *entry.as_table();
        PredictedModes mode{table["robot"].value_or(std::string()), {}};
        for (const char* law : {"world", "joint", "linear"})
          if (const auto ratio = table[law].value<double>()) mode.ratio[law] = *ratio;
        predictions.modes.push_back(mode);
      }
  } catch (const toml::parse_error& error) {
    throw InputError({{file.string(), static_cast<int>(error.source().begin.line), "",
                       std::string(error.description()), "mend the file, or give --assets"}});
  }
  return predictions;
}

}  // namespace twinarm
