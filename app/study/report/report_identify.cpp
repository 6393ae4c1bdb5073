// Slots of the report on what the paper's Table 2 leaves open.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/study/report/report_slots.h"

namespace twinarm {
namespace {

// A row does not show a combination of parameters that has to change by more than this factor
// before one of the four numbers moves by half of its last digit.
constexpr double kOpenFactor = 1.25;

std::string short_name(const std::string& parameter) {
  if (parameter == "arm2_mass_scale") return "m";
  if (parameter == "time_constant") return "T";
  if (parameter == "damping_ratio") return "ζ";
  return escaped(parameter);
}

std::string parameter_words(const Identification& found, std::size_t j) {
  const Identification::Interval in = found.interval(found.profiles[j]);
  std::string words =
      fmt::format("<span class=value>{} = {} <span class=small>",
                  short_name(found.fit.parameters[j].name), rounded(found.fit.parameters[j].value));
  if (in.open_low && in.open_high)
    words += "<span class=no>open</span>";
  else
    words += fmt::format("[{}{}, {}{}]", in.open_low ? "&lt; " : "", rounded(in.low),
                         in.open_high ? "&gt; " : "", rounded(in.high));
  return words + "</span></span> ";
}

bool is_open(double singular_value) {
  return !(singular_value * std::log(kOpenFactor) > 1);
}

bool leaves_open(const Identification& found) {
  return std::any_of(found.singular_values.begin(), found.singular_values.end(), is_open);
}

// The combinations that the row does not hold: "k1 b1^-0.9", those parts that weigh.
std::string open_combinations(const Identification& found) {
  if (!leaves_open(found)) return "none";
  std::string words;
  for (std::size_t i = 0; i < found.singular_values.size(); ++i) {
    if (!is_open(found.singular_values[i])) continue;
    const std::vector<double>& v = found.directions[i];
    const auto largest = std::max_element(
        v.begin(), v.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    std::string product;
    for (std::size_t j = 0; j < v.size(); ++j) {
      const double power = v[j] / *largest;
      if (std::abs(power) < 0.15) continue;
      const std::string exponent =
          std::abs(power - 1) < 0.05 ? "" : fmt::format("<sup>{:.1f}</sup>", power);
      const std::string& name = found.fit.parameters[j].name;
      product += (product.empty() ? "" : " ") + (name == "arm2_mass_scale" ? "m" : escaped(name)) +
                 exponent;
    }
    words += (words.empty() ? "" : ", ") + product;
  }
  return words;
}

// Over all parameters that the profiles found within the allowance.
std::string other_motion(const Identification& found) {
  std::array<double, 2> low{HUGE_VAL, HUGE_VAL}, high{0, 0};
  for (const Profile& profile : found.profiles)
    for (const ProfilePoint& point : profile.points)
      for (std::size_t j = 0; j < 2 && point.misfit <= found.allowance(); ++j) {
        low[j] = std::min(low[j], point.other_max_deg[j]);
        high[j] = std::max(high[j], point.other_max_deg[j]);
      }
  return fmt::format("{} .. {} / {} .. {}", degrees(low[0]), degrees(high[0]), degrees(low[1]),
                     degrees(high[1]));
}

// The four numbers of Table 2: two cells.
std::string number_cells(const std::array<double, 2>& max_deg,
                         const std::array<double, 2>& mean_deg) {
  return fmt::format("<td>{:.2f} / {:.2f}</td><td>{:.2f} / {:.2f}</td>", max_deg[0], max_deg[1],
                     mean_deg[0], mean_deg[1]);
}

std::string law_row(const Identification& found) {
  const bool agrees = found.fit.objective <= 1;
  std::string html =
      fmt::format("<tr><td class=text>{}</td><td>{:g}</td><td><span class={}>{}</span></td>",
                  escaped(family_law(found.law).words), found.fit.rate, agrees ? "yes" : "no",
                  rounded(found.fit.objective));
  const auto number = [&](const char* name) { return found.fit.numbers.at(name); };
  html += number_cells({number("max1_deg"), number("max2_deg")},
                       {number("mean1_deg"), number("mean2_deg")});
  html += "<td class=text>";
  for (std::size_t j = 0; j < found.profiles.size(); ++j) html += parameter_words(found, j);
  html += "</td>";
  return html + fmt::format("<td class=text>{}</td><td>{}</td></tr>\n", open_combinations(found),
                            other_motion(found));
}

std::string row_table(const std::vector<Identification>& all, const std::string& row) {
  std::string rows;
  for (const FamilyLaw& law : family_laws())
    for (const Identification& found : all)
      if (found.row == row && found.law == law.name) rows += law_row(found);
  const PaperRow& paper = paper_table().at(row);
  const std::string published = "<tr><td class=text><b>published</b></td><td></td><td></td>" +
                                number_cells(paper.max_deg, paper.mean_deg) +
                                "<td></td><td></td><td></td></tr>\n";
  return "<h3>" + row +
         "</h3>\n<div class=scroll><table class=dense><thead><tr><th class=text>law</th>"
         "<th>rate<br>Hz</th><th>misfit</th><th>max, degrees,<br>joints 1 / 2</th>"
         "<th>mean, degrees,<br>joints 1 / 2</th><th class=text>parameters, and how far they can "
         "go</th><th class=text>not held</th>"
         "<th>max at half speed,<br>degrees, joints 1 / 2</th></tr></thead><tbody>\n" +
         published + rows + "</tbody></table></div>\n";
}

// What the rows say of all laws together.
std::string open_sums(const std::vector<Identification>& all) {
  std::string html;
  for (const char* row : {"E3", "E4"}) {
    int asked = 0, agree = 0, open = 0;
    for (const Identification& found : all) {
      if (found.row != row) continue;
      ++asked;
      if (found.fit.objective > 1) continue;
      ++agree;
      if (leaves_open(found)) ++open;
    }
    html += fmt::format(
        "<li>{}: {} of {} pairs of law and rate agree with all four numbers to the digit; {} of "
        "those leave a combination of their parameters open.</li>\n",
        row, agree, asked, open);
  }
  return html;
}

}  // namespace

void add_identification(const StudyResults& results, Slots& slots) {
  const std::vector<Identification>& all = results.identifications;
  slots["open_sums"] = open_sums(all);
  for (const char* row : {"E3", "E4"}) slots[std::string("open_") + row] = row_table(all, row);
}

}  // namespace twinarm
