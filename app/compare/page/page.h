// Page of `twinarm compare --html`: one self-contained file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/compare/compare.h"

namespace twinarm::compare_page {

// File of --html FOLDER or --html FILE.html.
std::filesystem::path page_file(const std::filesystem::path& asked);

// Replaces "mu", "rad/s^2" .. by Unicode characters, and escapes the text for HTML.
std::string in_unicode(std::string words);

// Place of a case in the compiled source.
struct CasePlace {
  std::string file;  // "joints/pendulum.cpp", in benchmarks/analytic/; empty: not found
  std::size_t line = 0;
};
CasePlace place_of(const std::string& case_name);

// Section of one case: statement, figures, place of its code. Runs the case again for the figures,
// with all integrators.
std::string case_section(const CompareRow& row, const std::vector<Integration>& integrations);

// The whole page, sections in the order of rows; `command` is printed in the footer.
std::string page_html(const std::vector<CompareRow>& rows, const std::vector<std::string>& sections,
                      const std::vector<const SkippedCase*>& skipped, const std::string& command,
                      double seconds);

}  // namespace twinarm::compare_page
