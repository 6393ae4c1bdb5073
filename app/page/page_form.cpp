#include "app/page/page_form.h"

#include <utility>
#include <vector>

#include "app/data/html_page.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

std::string without_tags(std::string json) {  // "</script>" in a name would end the block
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos; at += 6)
    json.replace(at, 1, "\\u003c");
  return json;
}

}  // namespace

void require_form(std::string_view form, std::string_view missing, const std::string& instead) {
  if (form.empty())
    throw InputError({{"", 0, "page", "there is no page to fill in",
                       std::string(missing) + "; " + instead, "page.missing"}});
}

std::string fill_form(std::string_view form, const std::string& title, const JsonWriter& json,
                      const PageBytes& bytes) {
  const std::vector<std::pair<std::string, std::string>> parts{{"@TITLE@", escaped(title)},
                                                               {"@RUN@", without_tags(json.str())},
                                                               {"@BYTES@", bytes.packed()}};
  std::string html;
  for (const auto& [mark, text] : parts) {  // in their order; each is there once
    const std::size_t at = form.find(mark);
    html += std::string(form.substr(0, at)) + text;
    form.remove_prefix(at + mark.size());
  }
  return html + std::string(form);
}

}  // namespace twinarm
