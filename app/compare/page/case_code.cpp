#include "app/compare/page/case_code.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/data/html_page.h"
#include "benchmarks/analytic/registry/case_sources.h"

namespace twinarm::compare_page {

// The name may be put together from a beginning that ends with a hyphen. The mechanism's own name
// may stand before; what registers comes last.
CasePlace place_of(const std::string& case_name) {
  for (std::string name = case_name; name.size() >= 2; name.pop_back())
    for (const CaseSource& source : case_sources()) {
      if (source.text.find("\nCaseFamily ") == std::string_view::npos) continue;
      const std::size_t at = source.text.rfind("\"" + name + "\"");
      if (at == std::string_view::npos) continue;
      const auto begin = source.text.begin(), end = begin + static_cast<std::ptrdiff_t>(at);
      return {std::string(source.file), 1 + static_cast<std::size_t>(std::count(begin, end, '\n'))};
    }
  return {};
}

std::string link_to_code(const std::string& case_name) {
  const CasePlace place = place_of(case_name);
  if (place.file.empty()) return "";
  return fmt::format(
      "<p class=note>Code: <a href=\"#code-{0}\">benchmarks/analytic/{0}</a>, line {1}</p>\n",
      place.file, place.line);
}

std::string code_of(const std::vector<std::string>& case_names) {
  std::set<std::string> files;
  for (const std::string& name : case_names) files.insert(place_of(name).file);
  std::string html;
  for (const CaseSource& source : case_sources())
    if (files.count(std::string(source.file)))
      html += fmt::format(
          "<details><summary id=\"code-{0}\">benchmarks/analytic/{0}</summary>\n<pre>{1}</pre>"
          "</details>\n",
          source.file, escaped(std::string(source.text)));
  return html;
}

}  // namespace twinarm::compare_page
