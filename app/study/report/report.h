// The study's report: one page that holds everything it shows.
#pragma once

#include <filesystem>

#include "app/study/findings/results.h"

namespace twinarm {

// Writes folder/report.html, self-contained: assets/study/report.html with the numbers, tables, and
// SVGs and PNGs of folder/figures (write_figures) and folder/pictures in their places; no script,
// no network. Throws InputError where the text has a place for which there is nothing.
void write_report(const StudyResults& results, const std::filesystem::path& assets,
                  const std::filesystem::path& folder);

}  // namespace twinarm
