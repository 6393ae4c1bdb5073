// Self-contained HTML pages with the style sheet of the report.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace twinarm {

std::string with_powers(const std::string& text);  // 1.2e-05 as 1.2 × 10 with exponent −5
std::string yes_no(bool yes, const char* yes_word, const char* no_word);  // green or red

struct HtmlPage {
  std::string title, style;  // style: added to the style sheet
  std::string header;        // HTML, as the members below
  std::vector<std::pair<std::string, std::string>>
      contents;  // ids and names; empty: no bar of links
  std::string main, footer;

  std::string html() const;
};

// An SVG file for inclusion in a page. `label`: what screen readers say, as plain text.
std::string inline_svg(const std::string& file, const std::string& label = "Figure");
// Start of a footer: the command and its duration.
std::string made_by(const std::string& command, double seconds);

std::string base64_of(const std::string& bytes);

}  // namespace twinarm
