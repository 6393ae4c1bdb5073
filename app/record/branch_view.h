// A fork beside its recording: tables and a figure.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "app/record/record_run.h"

namespace twinarm {

// Of both branches since the fork: there the springs of the fork may hold another energy, but what
// rows have gained since then can be compared.
struct ComparedWork {
  std::string name;
  double recorded = 0, fork = 0;  // [J]
};
struct ComparedMomentum {
  std::string name;
  Eigen::Matrix<double, 6, 1> recorded, fork;  // linear [N s], angular [N m s]
};
struct ComparedBalances {
  std::vector<ComparedWork> works;
  std::vector<ComparedMomentum> momenta;
};
ComparedBalances compared_ledgers(const Replay& recorded, const Replay& fork);

// The values that part most, then both ledgers, with the differences.
void print_fork(const Recording& recording, const Replay& recorded, const Replay& fork);
// Before a long run: makes the folder. Throws InputError where the figure could not be drawn.
void check_plot(const std::filesystem::path& file);
// The value that parts most over the rows of the ledger that do. Throws InputError.
void draw_fork(const Recording& recording, const Replay& recorded, const Replay& fork,
               const std::vector<std::string>& changes, const std::filesystem::path& file);

}  // namespace twinarm
