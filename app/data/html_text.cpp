#include "app/data/html_text.h"

#include <fmt/format.h>

namespace twinarm {

std::string escaped(const std::string& text) {
  std::string html;
  for (char c : text) switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  return html;
}

std::string yes_no(bool yes, const char* yes_word, const char* no_word) {
  return fmt::format("<span class={}>{}</span>", yes ? "yes" : "no", yes ? yes_word : no_word);
}

}  // namespace twinarm
