// What the page adds to the style sheet of the study's report.
#pragma once

namespace twinarm::compare_page {

inline constexpr const char* kPageStyle = R"css(
table.index td { white-space: nowrap; }
table.index td.text { white-space: normal; min-width: 16rem; width: 100%; }
table.index td:first-child { white-space: normal; min-width: 7.5rem; }
table.index { font-size: .82rem; line-height: 1.35; }
table.index th, table.index td { padding: .2rem .45rem; }
table.index tr.group th { text-align: left; padding-top: .9rem; font-size: .92rem; }
.skipped { color: var(--soft); font-weight: 600; }
a { color: var(--kvr); }
section.case { margin: 0 0 2.6rem; border-top: 1px solid var(--line); padding-top: .9rem; }
section.case h3 { margin: 0 0 .3rem; font-size: 1.16rem; }
section.case h3 .yes, section.case h3 .no { font-size: .85rem; margin-left: .6rem; }
section.case h3 .what { font-weight: 400; color: var(--soft); font-size: .92rem; margin-left: .6rem; }
section.case figure { margin: .7rem 0; }
.formula { margin: .55rem 0 .55rem 1.6rem; max-width: 76ch; font: 1.09rem/1.65 "STIX Two Text",
  "Cambria Math", Cambria, "Latin Modern Roman", "Liberation Serif", "DejaVu Serif", Georgia, serif; }
.formula sub, .formula sup { font-size: .72em; line-height: 0; }
.statement { max-width: 74ch; }
.facts { display: flex; flex-wrap: wrap; gap: .1rem 1.7rem; font-size: .9rem; margin: .5rem 0; }
.facts b { font-weight: 600; font-variant-numeric: tabular-nums; }
.facts span { color: var(--soft); }
figure svg { font: 13px "DejaVu Sans", Verdana, sans-serif; color: #000; stroke: currentColor;
  stroke-linecap: round; stroke-linejoin: round; }
.pair > .note { align-self: center; margin: 0; }
section.case p sub, section.case p sup { line-height: 0; font-size: .72em; }
.readings { width: auto; }
.command { margin: .6rem 0; padding: .45rem .8rem; }
details pre { font-size: .76rem; }
@media print {
  section.case { break-inside: auto; margin-bottom: 1.1rem; padding-top: .5rem; }
  section.case h3, .facts, .formula { break-after: avoid; break-inside: avoid; }
  .formula { font-size: 10.4pt; line-height: 1.5; }
  table.index { font-size: 6.8pt; }
  table.index th, table.index td { padding: .1rem .22rem; }
  table.index td.text, table.index td:first-child { min-width: 0; }
  figcaption, .note { font-size: 8pt; margin-top: .1rem; }
  section.case p { margin: .3rem 0; }
  section.case h3 { font-size: 11pt; }
  .facts, .readings { font-size: 8.4pt; }
  .command { padding: .25rem .6rem; }
  .pair { gap: 0 10px; break-inside: avoid; }
  section.case figure { margin: .3rem 0; }
  section.case figure.wide svg { width: 86%; }
  .pair svg { width: 92%; }
  .readings { break-inside: avoid; }
  details { display: none; }
  details[open] { display: block; }
  a { color: inherit; text-decoration: none; }
}
)css";

}  // namespace twinarm::compare_page
