#include "app/data/html_page.h"

#include <fmt/format.h>

#include <cstdint>
#include <regex>

#include "solver/support/text.h"

namespace twinarm {
namespace {

// Style sheet for screen and print, without external fonts, scripts or images.
constexpr const char* kReportStyle = R"css(
:root { color-scheme: light dark; --ground: #fff; --ink: #1c2126; --soft: #5d6770;
  --line: #d9dde1; --pale: #f5f6f7; --chosen: #f8f1e2; --shade: #0003;
  --kvr: #47698a; --dvr: #b0490a; --good: #1e6b3c; --bad: #a03020; }
@media screen and (prefers-color-scheme: dark) {
  :root { --ground: #191919; --ink: #e8edf3; --soft: #a9b3bd; --line: #3a4047; --pale: #23272c;
    --chosen: #3a321f; --shade: #fff3; --kvr: #93b8da; --dvr: #f29a5c; --good: #6fce97;
    --bad: #f39383; }
  figure svg { filter: invert(.9) hue-rotate(180deg) brightness(1.2); }
}
* { box-sizing: border-box; }
html { scroll-padding-top: 3.2rem; background: var(--ground); }
a { color: var(--kvr); }
body { margin: 0; color: var(--ink); font: 16px/1.55 system-ui, -apple-system, "Segoe UI",
  Roboto, "Helvetica Neue", "DejaVu Sans", Arial, sans-serif; }
main, header { max-width: 960px; margin: 0 auto; padding: 0 20px; }
header { padding-top: 1.4rem; }
h1 { font-size: clamp(1.5rem, 4.5vw, 2.05rem); line-height: 1.2; margin: 0 0 .5rem; letter-spacing: -.015em; }
h2 { font-size: 1.4rem; margin: 3.2rem 0 .8rem; padding-top: .7rem;
  border-top: 2px solid var(--ink); letter-spacing: -.01em; }
h3 { font-size: 1.04rem; margin: 1.9rem 0 .5rem; }
p { margin: .55rem 0; max-width: 74ch; }
.lead { font-size: 1.1rem; color: var(--soft); }
.headline { font-size: clamp(1.1rem, 3vw, 1.25rem); line-height: 1.4; font-weight: 600; }
.note, figcaption, .small { font-size: .875rem; color: var(--soft); }
nav { position: sticky; top: 0; z-index: 2; margin-top: 1.2rem; background: var(--ground);
  border-bottom: 1px solid var(--line); font-size: .85rem; }
nav div { max-width: 960px; margin: 0 auto; padding: .5rem 20px; display: flex; flex-wrap: wrap;
  gap: 0 1.05rem; }
nav a { color: var(--soft); text-decoration: none; white-space: nowrap; line-height: 24px; }
nav:has(div:empty) { display: none; }
nav a:hover { color: var(--dvr); text-decoration: underline; }
figure { margin: 1.5rem 0 2rem; break-inside: avoid; }
figure svg > g > rect:first-child { fill: none; }  /* the page shows through */
figure svg, figure img { display: block; width: 100%; height: auto; }
figure img { border: 1px solid var(--line); border-radius: 3px; }
figcaption { margin-top: .45rem; max-width: 84ch; }
figcaption b { color: var(--ink); }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 0 16px; }
.pair figure { margin: .7rem 0; }
/* Scrolls sideways, with a shadow at an edge that hides something; a table may be wider than text. */
.scroll { overflow-x: auto; background:
  linear-gradient(90deg, var(--ground) 60%, transparent) 0 0 / 40px 100% local no-repeat,
  linear-gradient(270deg, var(--ground) 60%, transparent) 100% 0 / 40px 100% local no-repeat,
  linear-gradient(90deg, var(--shade), transparent) 0 0 / 16px 100% no-repeat,
  linear-gradient(270deg, var(--shade), transparent) 100% 0 / 16px 100% no-repeat; }
main .scroll:has(> table) { width: fit-content; min-width: 100%; max-width: calc(100vw - 56px);
  margin-left: 50%; transform: translateX(-50%); }
table { border-collapse: collapse; width: 100%; margin: .7rem 0 1.1rem; font-size: .9rem;
  font-variant-numeric: tabular-nums; }
th, td { padding: .27rem .55rem; text-align: right; border-bottom: 1px solid var(--line);
  vertical-align: top; }
th:first-child, td:first-child, .text { text-align: left; }
thead th { border-bottom: 1.5px solid var(--ink); font-weight: 600; vertical-align: bottom; }
thead tr:first-child:not(:last-child) th { border-bottom: 1px solid var(--line); }
td.big { font-weight: 600; }
.first { border-left: 1px solid var(--line); }
tr.chosen td { background: var(--chosen); font-weight: 600; }
table.dense { font-size: .775rem; line-height: 1.35; }
table.dense th, table.dense td { padding: .2rem .38rem; }
td { white-space: nowrap; }
td.text, td.wrap, table.claims td, table.dense td:first-child { white-space: normal; }
sub, sup { line-height: 0; }
.factor { display: inline-block; line-height: 1.7; }
td:has(.factor) { min-width: 10.5rem; } table.dense td:first-child { min-width: 8rem; }
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
summary { cursor: pointer; padding: .35rem 0; }
summary h2 { display: inline; margin: 0; padding: 0; border: 0; font-size: 1.15rem; }
summary:has(h2) { padding: .55rem 0; border-top: 1px solid var(--line); }
details details summary { color: var(--soft); font-size: .9rem; }
details[open] > summary:has(h2) { margin-bottom: .6rem; }
footer { max-width: 960px; margin: 3rem auto 2rem; padding: 1rem 20px 0; color: var(--soft);
  font-size: .85rem; border-top: 1px solid var(--line); }
@media (max-width: 640px) { .pair { grid-template-columns: 1fr; } figure svg { min-width: 620px; } }
@page { size: A4; margin: 16mm 15mm; }
@media print {
  body { font-size: 9.6pt; }
  nav { display: none; }
  summary { list-style: none; break-after: avoid; }
  details::details-content { content-visibility: visible; }
  main, header { max-width: none; padding: 0; }
  header { padding-top: 0; }
  h2 { margin-top: 1.6rem; break-after: avoid; }
  h3, h2 + p, h3 + p, thead { break-after: avoid; }
  tr { break-inside: avoid; }
  thead { display: table-header-group; }
  .scroll { overflow: visible; background: none; }
  main .scroll:has(> table) { margin-left: 0; transform: none; max-width: none; width: auto; }
  table.dense { font-size: 6pt; }
  table.dense th, table.dense td { padding: .12rem .22rem; }
  table.dense td, table.dense td:first-child { min-width: 0; }
  td, .value { white-space: normal; }
  pre { font-size: 7.6pt; }
  tr.chosen td { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
}
)css";

}  // namespace

std::string with_powers(const std::string& text) {
  static const std::regex minus("\\b([0-9.]+)e-0*([0-9]+)\\b"),
      plus("\\b([0-9.]+)e\\+?0*([0-9]+)\\b");
  return std::regex_replace(std::regex_replace(text, minus, "$1 × 10<sup>−$2</sup>"), plus,
                            "$1 × 10<sup>$2</sup>");
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

std::string inline_svg(const std::string& file, const std::string& label) {
  const std::size_t begin = file.find("<svg");  // without the XML declaration
  if (begin == std::string::npos) return "";
  return "<svg role=img aria-label=\"" + escaped(label) + "\"" + file.substr(begin + 4);
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
