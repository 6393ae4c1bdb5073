// `twinarm compare --html`: one page with all that was run, nothing outside of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/compare/compare.h"

namespace twinarm::compare_page {

// The file that --html FOLDER or --html FILE.html means.
std::filesystem::path page_file(const std::filesystem::path& asked);

// Whether the file could be written, and gnuplot is there: before anything is run. Adds to faults.
void check_page(const std::filesystem::path& file, DiagnosticList& faults);

// What a terminal shows as "mu" or "rad/s^2"; escaped.
std::string in_unicode(std::string words);

// Where a case is written, of the files as they were compiled.
struct CasePlace {
  std::string file;  // "joints/pendulum.cpp", of benchmarks/analytic/; empty: not found
  std::size_t line = 0;
};
CasePlace place_of(const std::string& case_name);

// The section of one case: statement, figures, place of its code. Runs it again to be looked at,
// and all integrators beside; takes a temporary folder.
std::string case_section(const CompareRow& row, const std::vector<Lane>& integrations);

// The whole page, from the sections in the order of rows. `command` made it.
std::string page_html(const std::vector<CompareRow>& rows, const std::vector<std::string>& sections,
                      const std::vector<const SkippedCase*>& skipped, const std::string& command,
                      double seconds);

}  // namespace twinarm::compare_page
