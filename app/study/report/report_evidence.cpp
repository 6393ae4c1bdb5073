// Slots of the report on the evidence: what the paper says as numbers, and each fit beside it.

#include "app/study/findings/findings.h"
#include "app/study/report/report_slots.h"

namespace twinarm {
namespace {

std::string statement_rows() {
  std::string html;
  for (const PaperStatement& s : kPaperStatements)
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td class=text>{}</td><td class=text>{}</td><td>{:g} to "
        "1</td><td>{:g} to {:g}</td></tr>\n",
        s.run, s.figure, escaped(s.says), escaped(s.words), s.agrees, s.contradicts, s.agrees);
  return html;
}

std::string share_cell(const std::string& run, double share) {
  const Verdict verdict = verdict_of(statement_on(run), share);
  const char* words = verdict == Verdict::agrees ? "<span class=yes>agrees</span>"
                      : verdict == Verdict::open ? "<span class=small>open</span>"
                                                 : "<span class=no>contradicts</span>";
  return fmt::format("<td>{:.2f}<br>{}</td>", share, words);
}

std::string evidence_row(const Evidence& e, bool remains) {
  std::string html = fmt::format(
      "<tr{}><td class=text>{}, {:g} Hz{}<br><span class=small>k&nbsp;= {}, b&nbsp;= {}, m&nbsp;= "
      "{}</span></td><td>{}<br>{}</td><td>{}</td>",
      e.is_used ? " class=chosen" : "", typeset(e.law), e.rate, e.is_used ? " (used here)" : "",
      gains_words(e.gains.k1, e.gains.k2, unit_of("k", e.row != "E3")),
      gains_words(e.gains.b1, e.gains.b2, unit_of("b", e.row != "E3")), rounded(e.arm2_mass_scale),
      rounded(e.damping_ratio[0]), rounded(e.damping_ratio[1]), e.parameters);
  for (const double misfit : e.misfit)
    html += fmt::format("<td{}><span class={}>{}</span></td>",
                        &misfit == e.misfit.data() ? " class=first" : "",
                        misfit <= 1 ? "yes" : "no", misfit < 1000 ? rounded(misfit) : "–");
  html += share_cell(e.row, e.figure) + fmt::format("<td>{} of 4</td>", e.user_numbers) +
          share_cell(e.user_row(), e.user_figure);
  return html + "<td>" + (remains ? "<span class=yes>remains</span>" : "–") + "</td></tr>\n";
}

std::string evidence_table(const std::vector<Evidence>& all, const std::string& row) {
  const std::vector<const Evidence*> left = remaining(all, row);
  const std::string user = row == "E3" ? "E1" : "E2";
  std::string rows;
  for (const Evidence& e : all) {
    if (e.row != row) continue;
    rows += evidence_row(e, std::ranges::find(left, &e) != left.end());
  }
  return fmt::format(
      "<h3>{}</h3>\n<div class=scroll tabindex=0><table class=dense><thead><tr><th rowspan=2 "
      "class=text>law, rate, gains</th><th rowspan=2>damping<br>ratio</th><th "
      "rowspan=2>fitted</th><th colspan=4 class=first>misfit, half digits</th><th "
      "rowspan=2>Figure<br>{}</th><th rowspan=2>{}<br>inside</th><th "
      "rowspan=2>Figure<br>{}</th><th rowspan=2></th></tr>\n"
      "<tr><th class=first>max 1</th><th>max 2</th><th>mean 1</th><th>mean "
      "2</th></tr></thead><tbody>\n{}</tbody></table></div>\n",
      row == "E4-text" ? "E4 with the numbers of the text: 4.0 instead of 6.0, 0.34 instead of 0.3"
                       : row,
      statement_on(row).figure, user, statement_on(user).figure, rows);
}

}  // namespace

void add_evidence(const StudyResults& results, Slots& slots) {
  slots["statement_rows"] = statement_rows();
  slots["evidence_operators"] = fmt::format("{}", kEvidenceOperators);
  for (const char* row : {"E3", "E4", "E4-text"}) {
    std::string name = std::string("evidence_") + row;
    std::ranges::replace(name, '-', '_');
    slots[name] = evidence_table(results.evidence, row);
  }
  for (const char* row : {"E3", "E4"})
    slots[std::string("evidence_words_") + row] = typeset(evidence_in_words(results.evidence, row));
  std::size_t readings = 0, agree = 0;
  for (const Evidence& e : results.evidence) {
    readings += e.row == "E4-text";
    agree += e.row == "E4-text" && e.has_numbers();
  }
  slots["evidence_words_text"] = fmt::format(
      "The text's 4.0 for joint 2 of E4 can be met as well: refitted to it, {} of {} readings "
      "agree with all four numbers. The numbers alone do not tell which of the two is the slip.",
      agree, readings);
}

}  // namespace twinarm
