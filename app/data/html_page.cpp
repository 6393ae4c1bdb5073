#include "app/data/html_page.h"

#include <fmt/format.h>
#include <cstdint>

namespace twinarm {
namespace {

// Style sheet for screen and print, without external fonts, scripts or images.
constexpr const char* kReportStyle = R"css(
:root { color-scheme: light; --ink: #1c2126; --soft: #5d6770; --line: #d9dde1; --pale: #f5f6f7;
  --kvr: #5d7f9e; --dvr: #b9520a; --good: #1e6b3c; --bad: #a03020; }
* { box-sizing: border-box; }
html { scroll-behavior: smooth; scroll-padding-top: 3.2rem; }
body { margin: 0; color: var(--ink); background: #fff; font: 16px/1.55 system-ui, -apple-system,
  "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", Arial, sans-serif; }
main, header { max-width: 960px; margin: 0 auto; padding: 0 20px; }
header { padding-top: 2.6rem; }
h1 { font-size: 2.05rem; line-height: 1.2; margin: 0 0 .5rem; letter-spacing: -.015em; }
h2 { font-size: 1.4rem; margin: 3.2rem 0 .8rem; padding-top: .7rem;
  border-top: 2px solid var(--ink); letter-spacing: -.01em; }
h3 { font-size: 1.04rem; margin: 1.9rem 0 .5rem; }
p { margin: .55rem 0; max-width: 74ch; }
.lead { font-size: 1.1rem; color: var(--soft); }
.note, figcaption, .small { font-size: .875rem; color: var(--soft); }
nav { position: sticky; top: 0; z-index: 2; margin-top: 1.2rem; background: rgba(255,255,255,.97);
  border-bottom: 1px solid var(--line); font-size: .85rem; }
nav div { max-width: 960px; margin: 0 auto; padding: .5rem 20px; display: flex; flex-wrap: wrap;
  gap: .1rem 1.05rem; }
nav a { color: var(--soft); text-decoration: none; white-space: nowrap; }
nav a:hover { color: var(--dvr); text-decoration: underline; }
.answer { background: var(--pale); border-left: 4px solid var(--dvr); padding: .9rem 1.3rem;
  margin: 1.2rem 0; }
.answer ol { margin: 0; padding-left: 1.3rem; }
.answer li { margin: .4rem 0; }
figure { margin: 1.5rem 0 2rem; break-inside: avoid; }
figure svg, figure img { display: block; width: 100%; height: auto; }
figure img { border: 1px solid var(--line); border-radius: 3px; }
figcaption { margin-top: .45rem; max-width: 84ch; }
figcaption b { color: var(--ink); }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 0 16px; }
.pair figure { margin: .7rem 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; margin: .7rem 0 1.1rem; font-size: .9rem;
  font-variant-numeric: tabular-nums; }
th, td { padding: .27rem .55rem; text-align: right; border-bottom: 1px solid var(--line);
  vertical-align: top; }
th:first-child, td:first-child, .text { text-align: left; }
thead th { border-bottom: 1.5px solid var(--ink); font-weight: 600; vertical-align: bottom; }
thead tr:first-child:not(:last-child) th { border-bottom: 1px solid var(--line); }
td.big { font-weight: 600; }
.first { border-left: 1px solid var(--line); }
tr.chosen td { background: #f8f1e2; font-weight: 600; }
table.dense { font-size: .775rem; line-height: 1.35; }
table.dense th, table.dense td { padding: .2rem .38rem; }
td { white-space: nowrap; }
td.text, table.claims td, table.dense td:first-child { white-space: normal; }
.value { white-space: nowrap; display: inline-block; margin-right: .9rem; }
table.dense .small { font-size: inherit; }
.yes { color: var(--good); font-weight: 600; white-space: nowrap; }
.no { color: var(--bad); font-weight: 600; white-space: nowrap; }
.tag { display: inline-block; font-size: .72rem; font-weight: 600; letter-spacing: .03em;
  padding: .04rem .45rem; border: 1px solid currentColor; border-radius: 3px; color: var(--kvr);
  vertical-align: .12em; margin-left: .4rem; white-space: nowrap; }
.tag.prediction { color: var(--dvr); }
pre, code { font: .82rem/1.45 ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono",
  monospace; }
pre { background: var(--pale); padding: .9rem 1.1rem; overflow-x: auto; white-space: pre-wrap; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .25rem 1.2rem; font-size: .92rem; }
dt { color: var(--soft); }
dd { margin: 0; overflow-wrap: anywhere; }
summary { cursor: pointer; color: var(--soft); font-size: .9rem; margin: .6rem 0; }
footer { max-width: 960px; margin: 3rem auto 2rem; padding: 1rem 20px 0; color: var(--soft);
  font-size: .85rem; border-top: 1px solid var(--line); }
@media (max-width: 640px) { .pair { grid-template-columns: 1fr; } h1 { font-size: 1.6rem; } }
@page { size: A4; margin: 16mm 15mm; }
@media print {
  body { font-size: 9.6pt; }
  nav, summary { display: none; }
  main, header { max-width: none; padding: 0; }
  header { padding-top: 0; }
  h2 { margin-top: 1.6rem; break-after: avoid; }
  h3, h2 + p, h3 + p, thead { break-after: avoid; }
  tr, .answer { break-inside: avoid; }
  thead { display: table-header-group; }
  .scroll { overflow: visible; }
  table.dense { font-size: 6.9pt; }
  table.dense th, table.dense td { padding: .12rem .22rem; }
  pre { font-size: 7.6pt; }
  .answer, tr.chosen td { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
}
)css";

}  // namespace

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text)
    html += c == '&'   ? "&amp;"
            : c == '<' ? "&lt;"
            : c == '>' ? "&gt;"
            : c == '"' ? "&quot;"
                       : std::string(1, c);
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
