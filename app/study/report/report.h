// The study's report: one page that holds everything it shows.
#pragma once

#include <filesystem>

#include "app/study/findings/results.h"

namespace twinarm {

// Writes folder/report.html, self-contained: the SVGs of folder/figures (write_figures) and the
// PNGs of folder/pictures are inside, the style too; no script, no network. A figure or picture
// that is not there is left out.
void write_report(const StudyResults& results, const std::filesystem::path& folder);

}  // namespace twinarm
