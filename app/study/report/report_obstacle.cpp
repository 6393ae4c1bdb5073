// The report's section on the box in the way.
#include <fmt/format.h>

#include "app/study/report/report_sections.h"

namespace twinarm {

std::string obstacle_section(const StudyResults& results, const Gallery& gallery) {
  if (results.obstacle.empty()) return "";
  std::string html =
      "<h2 id=obstacle>A box in the way</h2>\n<p>The automatic motion, with a box that the DVR "
      "cannot enter. The KVR goes on through it; what the coupling then carries is the force that "
      "a "
      "haptic device would show to the hand.</p>\n";
  html += "<div class=scroll><table><thead><tr><th></th>";
  for (const ObstacleRun& run : results.obstacle) html += "<th>" + escaped(run.name) + "</th>";
  html += "</tr></thead><tbody>\n";
  const auto row = [&](const char* name, auto&& value) {
    html += fmt::format("<tr><td>{}</td>", name);
    for (const ObstacleRun& run : results.obstacle) html += "<td>" + value(run) + "</td>";
    html += "</tr>\n";
  };
  using R = const ObstacleRun&;
  row("treatment", [](R r) { return escaped(r.treatment); });
  row("stiffness on link 1; link 2", [](R r) {
    return gains_words(r.gains.k1, r.gains.k2) + (r.pull_unit == "N" ? " N/m" : " N m/rad");
  });
  row("damping on link 1; link 2", [](R r) {
    return gains_words(r.gains.b1, r.gains.b2) + (r.pull_unit == "N" ? " N s/m" : " N m s/rad");
  });
  row("longest contact", [](R r) {
    return r.contact_begin < 0 ? std::string("none")
                               : fmt::format("{:.3f} to {:.3f} s", r.contact_begin, r.contact_end);
  });
  row("largest penetration of the DVR",
      [](R r) { return fmt::format("{:.3f} mm", 1e3 * r.largest_penetration); });
  row("KVR beyond the touched face, at most",
      [](R r) { return fmt::format("{:.0f} mm", 1e3 * r.largest_beyond); });
  row("largest pull through the coupling",
      [](R r) { return fmt::format("{:.0f} {}", r.largest_pull, escaped(r.pull_unit)); });
  row("largest contact force", [](R r) { return fmt::format("{:.0f} N", r.largest_force); });
  row("largest R<sub>K</sub>/r that occurred", [](R r) {
    return r.target_radius_ratio > 0 ? rounded(r.target_radius_ratio) : std::string("–");
  });
  row("largest stable R<sub>K</sub>/r", [](R r) {
    return r.target_radius_limit > 0 ? rounded(r.target_radius_limit) : std::string("–");
  });
  html +=
      "</tbody></table></div>\n<p class=note>R<sub>K</sub>/r: distance of a point spring's target "
      "from the joint, over that of its end on the DVR. An implicit point spring holds only while "
      "h² k r R<sub>K</sub> &lt; 4 I + 2 r² (h² k + h b); the limit is printed for the spring "
      "and joint that came nearest to it. A torsional spring has no lever arm, and no such "
      "limit.</p>\n";
  html +=
      gallery.figure("obstacle",
                     "<b>The run into the box.</b> Shaded: contact. The DVR's joints stand still "
                     "while the KVR's go on; the pull grows with the distance between them, and "
                     "drops where the KVR turns back, because the damper changes sign. Spikes "
                     "of the contact force: the impacts.");
  std::string pair;
  for (const std::string& name : gallery.pictures())
    if (name.starts_with("obstacle")) pair += gallery.picture(name, picture_caption(name));
  return html + (pair.empty() ? "" : "<div class=pair>" + pair + "</div>\n");
}

}  // namespace twinarm
