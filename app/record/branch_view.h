// A branch and its recording: tables and a figure.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "app/record/record_run.h"

namespace twinarm {

// Changes of the balances since the branch began.
struct ComparedWork {
  std::string name;
  double recorded = 0, branch = 0;  // [J]
};
struct ComparedMomentum {
  std::string name;
  Eigen::Matrix<double, 6, 1> recorded, branch;  // linear [N s], angular [N m s]
};
struct ComparedBalances {
  std::vector<ComparedWork> works;
  std::vector<ComparedMomentum> momenta;
};
ComparedBalances compared_balances(const Replay& recorded, const Replay& branch);

// The values that differ most, then both balances with their differences.
void print_branch(const Recording& recording, const Replay& recorded, const Replay& branch);
// The value that differs most, and the rows of the energy balance that do. Throws InputError.
void draw_branch(const Recording& recording, const Replay& recorded, const Replay& branch,
                 const std::vector<std::string>& changes, const std::filesystem::path& file);

}  // namespace twinarm
