// Parts of report.cpp: each returns the HTML of one section, or nothing where it has no data.
#pragma once

#include <filesystem>
#include <string>

#include "app/data/html_page.h"
#include "app/study/findings/results.h"

namespace twinarm {

// Figures and pictures that may stand in the page.
class Gallery {
 public:
  explicit Gallery(std::filesystem::path folder) : folder_(std::move(folder)) {}
  // The caption is HTML. Empty where the file is not there.
  std::string figure(const std::string& name, const std::string& caption) const;
  std::string picture(const std::string& name, const std::string& caption) const;
  std::vector<std::string> pictures() const;  // names without .png, sorted

 private:
  std::filesystem::path folder_;
};

// A few significant digits for people, "infinite" and "none" in words.
std::string rounded(double value, int digits = 3);
std::string degrees(double value);                     // two decimals; more for a tiny one
std::string gains_words(double first, double second);  // "12.3", or "12.3; 4.56"

// report_sections.cpp: what was found
std::string table_2_section(const StudyResults& results);
std::string angles_section(const StudyResults& results, const Gallery& gallery);
std::string pictures_section(const Gallery& gallery);
std::string findings_section(const StudyResults& results, const Gallery& gallery);
std::string picture_caption(const std::string& name);

// report_obstacle.cpp: the box in the way
std::string obstacle_section(const StudyResults& results, const Gallery& gallery);

// report_tables.cpp: what was run beside E1 to E4
std::string rates_section(const StudyResults& results, const Gallery& gallery);
std::string variants_section(const StudyResults& results, const Gallery& gallery);
std::string recordings_section(const StudyResults& results);

// report_identify.cpp: what the paper's numbers cannot tell
std::string identification_section(const StudyResults& results, const Gallery& gallery);

// report_parameters.cpp: where the numbers come from
std::string search_section(const StudyResults& results, const Gallery& gallery);
std::string parameters_section(const StudyResults& results);

}  // namespace twinarm
