// What was predicted before: assets/study/predictions.toml. Data, so that no number is in the code.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace twinarm {

struct PredictedRow {
  std::string robot, law;
  double rate = 0;
  std::array<double, 2> max_deg{};
  std::optional<std::array<double, 2>> mean_deg;
};
struct PredictedModes {
  std::string robot;
  std::map<std::string, double> ratio;  // by law: world, joint, linear
};
struct Predictions {
  std::vector<PredictedRow> rows;
  std::vector<PredictedModes> modes;
};

Predictions read_predictions(const std::filesystem::path& assets);

}  // namespace twinarm
