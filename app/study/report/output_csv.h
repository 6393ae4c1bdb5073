// The runs as CSV: one file a run, units in the header.
#pragma once

#include <filesystem>

#include "app/study/findings/results.h"

namespace twinarm {

// Writes NAME.csv for each run of the reproduction and of the variants, obstacle_NAME.csv for the
// obstacle; slashes in names become underscores. Columns `name[unit]`: t[s], q_K/joint1[rad], ...,
// q_D/joint1[rad], ..., pull/joint1[N] or [N m]. Numbers: the shortest text that reads back to the
// same double. Throws InputError where the folder cannot be written.
void write_csv(const StudyResults& results, const std::filesystem::path& folder);

}  // namespace twinarm
