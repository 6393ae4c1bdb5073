// Pages that are one file: with the style sheet of the report, and nothing from outside.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace twinarm {

std::string escaped(const std::string& text);
// Green or red.
std::string yes_no(bool yes, const char* yes_word, const char* no_word);

struct HtmlPage {
  std::string title, style;                                   // what it adds to the style sheet
  std::string header;                                         // this and all below in HTML
  std::vector<std::pair<std::string, std::string>> contents;  // ids and names
  std::string main, footer;

  std::string html() const;
};

// An SVG file, to stand in a page.
std::string inline_svg(const std::string& file);
// The beginning of a footer: the command, and how long it took.
std::string made_by(const std::string& command, double seconds);

std::string base64_of(const std::string& bytes);

}  // namespace twinarm
