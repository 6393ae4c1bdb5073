#include "app/study/findings/predictions.h"

#include "app/data/toml_tree.h"

namespace twinarm {
namespace {

std::string text_of(const TomlValue& table, const char* key) {
  const TomlValue* value = table.find(key);
  return value ? value->text : "";
}

std::optional<std::array<double, 2>> pair_of(const TomlValue& table, const char* key) {
  const TomlValue* list = table.find(key);
  if (!list || list->items.size() != 2) return {};
  return std::array<double, 2>{list->items[0].number, list->items[1].number};
}

}  // namespace

Predictions read_predictions(const std::filesystem::path& assets) {
  const TomlValue root = read_toml(assets / "study" / "predictions.toml");
  Predictions predictions;
  if (const TomlValue* rows = root.find("row"))
    for (const TomlValue& row : rows->items) {
      const TomlValue* rate = row.find("rate");
      predictions.rows.push_back(
          {text_of(row, "robot"), text_of(row, "law"), rate ? rate->number : 0,
           pair_of(row, "max").value_or(std::array<double, 2>{}), pair_of(row, "mean")});
    }
  if (const TomlValue* modes = root.find("modes"))
    for (const TomlValue& table : modes->items) {
      PredictedModes& mode = predictions.modes.emplace_back();
      mode.robot = text_of(table, "robot");
      for (const char* law : {"world", "joint", "linear"})
        if (const TomlValue* ratio = table.find(law)) mode.ratio[law] = ratio->number;
    }
  return predictions;
}

}  // namespace twinarm
