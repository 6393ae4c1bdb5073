// The pages for people, one after the other: passes, wrenches, forces by name, checks.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/data/number_sheet.h"
#include "app/data/text_table.h"
#include "app/inspect/report/inspect_output.h"

namespace twinarm {
namespace {

void write_bodies(const Inspection& in, const InspectView& view, int pass,
                  const SubtreeErrors& errors, Sheet& sheet) {
  static constexpr std::array titles{
      "PASS 1, base to tips: velocities, and bias forces of the bodies alone",
      "PASS 2, tips to base: articulated-body inertias and bias forces",
      "PASS 3, base to tips: accelerations"};
  sheet.title(titles[static_cast<std::size_t>(pass - 1)], "RBDA table 7.1");
  std::vector<std::size_t> order = view.bodies;
  if (pass == 2) order.assign(view.bodies.rbegin(), view.bodies.rend());
  for (const std::size_t body : order) {
    write_body_head(in, body, sheet);
    write_pass(in, pass, body, errors.D[body], sheet);
  }
}

void write_checks(const std::vector<Check>& checks, Sheet& sheet) {
  sheet.title("CHECKS by independent algorithms", "of all bodies");
  TextTable table({"check", "worst error", "allowed", "at", ""});
  for (const Check& check : checks)
    table.add({fmt::format("{:<9} {}", check.name, check.meaning),
               fmt::format("{:.1e}", check.error), fmt::format("{:.0e}", check.tolerance),
               check.worst, check.pass() ? "ok" : "FAIL"});
  sheet.line(table.str());
}

// The largest rows, one after the other; what did nothing is left out.
void write_ledger(std::vector<LedgerRow> rows, Sheet& sheet) {
  constexpr std::size_t most = 24;
  if (rows.empty()) return;
  double change = 0;
  for (const LedgerRow& row : rows) change += row.work;
  std::erase_if(rows, [](const LedgerRow& row) { return row.work == 0; });
  std::ranges::stable_sort(rows, [](const LedgerRow& a, const LedgerRow& b) {
    return std::abs(a.work) > std::abs(b.work);
  });
  std::string text = " ";
  for (std::size_t i = 0; i < std::min(rows.size(), most); ++i)
    text += fmt::format(" {} {},", rows[i].name, cell(rows[i].work));
  if (rows.size() > most) text += fmt::format(" and {} smaller ones,", rows.size() - most);
  sheet.title("WORK ON THE BODIES since the start of the run [J]", "the largest first");
  sheet.line(
      wrapped(text + fmt::format(" together {}, the change of kinetic energy", cell(change))));
}

}  // namespace

std::string inspect_text(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks) {
  Sheet sheet;
  sheet.line(view.title);
  if (!view.forces_alone) {
    sheet.line("Spatial vectors: angular | linear, in the link's axes, about the link's origin.");
    const SubtreeErrors errors = subtree_errors(in);
    for (const int pass : view.passes) write_bodies(in, view, pass, errors, sheet);
    write_balances(in, view, sheet);
  }
  write_named_forces(in, view, sheet);
  if (!view.forces_alone) write_ledger(view.ledger, sheet);
  write_checks(checks, sheet);
  for (const std::string& warning : view.warnings) sheet.line(wrapped("warning: " + warning));
  return sheet.str();
}

}  // namespace twinarm
