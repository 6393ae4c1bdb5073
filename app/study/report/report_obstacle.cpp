// Slot of the report on the runs into a box.
#include <fmt/format.h>

#include <functional>

#include "app/study/report/report_slots.h"

namespace twinarm {
namespace {

// One column for each run.
std::string obstacle_rows(const std::vector<ObstacleRun>& runs) {
  using R = const ObstacleRun&;
  const auto unit = [](R r, const char* gain) {
    return unit_of(gain, r.spec.coupling.type == CouplingSpec::Type::linear);
  };
  const std::pair<const char*, std::function<std::string(R)>> rows[] = {
      {"discretization", [](R r) { return escaped(discretization_name(r.spec.coupling)); }},
      {"stiffness on link 1; link 2",
       [&](R r) { return gains_words(r.spec.gains.k1, r.spec.gains.k2, unit(r, "k")); }},
      {"damping on link 1; link 2",
       [&](R r) { return gains_words(r.spec.gains.b1, r.spec.gains.b2, unit(r, "b")); }},
      {"longest contact",
       [](R r) {
         return r.contact_begin < 0
                    ? "none"
                    : fmt::format("{:.3f} to {:.3f} s", r.contact_begin, r.contact_end);
       }},
      {"largest penetration of the DVR",
       [](R r) { return fmt::format("{:.3f} mm", 1e3 * r.max_penetration); }},
      {"largest depth of the KVR behind the touched face",
       [](R r) { return fmt::format("{:.0f} mm", 1e3 * r.max_beyond); }},
      {"largest coupling force or torque",
       [](R r) { return quantity(r.max_coupling, r.spec.coupling_force_unit()); }},
      {"largest contact force", [](R r) { return quantity(r.max_force, "N"); }},
      {"R<sub>K</sub>/r where it came nearest to its limit; the limit",
       [](R r) {
         const double limit = r.target_radius_limit;
         return limit > 0 ? gains_words(r.target_radius_ratio, limit) : std::string("–");
       }},
      {"limit exceeded from", [](R r) {
         const std::string end = yes_no(r.finite, "finite", "diverged");
         return r.exceeded_at < 0 ? "–" : fmt::format("{:.3f} s; {}", r.exceeded_at, end);
       }}};
  std::string html = "<tr><th></th>";
  for (R run : runs) html += "<th>" + escaped(run.spec.title) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const auto& [name, value] : rows) {
    html += fmt::format("<tr><td>{}</td>", name);
    for (R run : runs) html += "<td>" + value(run) + "</td>";
    html += "</tr>\n";
  }
  return html;
}

}  // namespace

void add_obstacle(const StudyResults& results, Slots& slots) {
  slots["obstacle_rows"] = obstacle_rows(results.obstacle);
}

}  // namespace twinarm
