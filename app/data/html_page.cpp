#include "app/data/html_page.h"

#include <fmt/format.h>
#include <cstdint>

#include "app/data/page_style.h"

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

std::string HtmlPage::html() const {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>\n"
      "<meta name=viewport content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style>{}{}</style></head><body>\n<header>{}</header>\n"
      "<nav aria-label=Contents><div>",
      title, kReportStyle, style, header);
  for (const auto& [id, name] : contents) html += fmt::format("<a href=\"#{}\">{}</a>", id, name);
  return html + "</div></nav>\n<main>\n" + main + "</main>\n<footer>" + footer +
         "</footer>\n</body></html>\n";
}

std::string inline_svg(const std::string& file) {
  const std::size_t begin = file.find("<svg");  // without the XML declaration
  return begin == std::string::npos ? "" : "<svg role=img" + file.substr(begin + 4);
}

std::string made_by(const std::string& command, double seconds) {
  return fmt::format("Made by <code>{}</code> in {:.0f} s.", escaped(command), seconds);
}

std::string base64_of(const std::string& bytes) {
  static const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * ((bytes.size() + 2) / 3));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace twinarm
