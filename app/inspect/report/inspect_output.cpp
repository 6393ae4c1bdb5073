#include "app/inspect/report/inspect_output.h"

#include <fmt/format.h>

namespace twinarm {
namespace {

void write_bodies(const Inspection& in, const InspectView& view, int pass,
                  const ReferenceErrors& errors, Sheet& sheet) {
  static constexpr std::array titles{
      "PASS 1, base to tips: velocities, velocity-product accelerations, bias forces",
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
  sheet.title("CROSS-CHECKS by independent algorithms", "of all bodies");
  TextTable table({"quantity", "largest error", "tolerance", "at", ""});
  for (const Check& check : checks)
    table.add({fmt::format("{:<9} {}", check.name, check.meaning),
               fmt::format("{:.1e}", check.error), fmt::format("{:.0e}", check.tolerance),
               check.worst, check.pass() ? "ok" : "FAIL"});
  sheet.line(table.str());
}

// The largest rows; zero rows are left out.
void write_energy_balance(std::vector<EnergyRow> rows, Sheet& sheet) {
  constexpr std::size_t kMaxRows = 24;
  if (rows.empty()) return;
  double change = 0;
  for (const EnergyRow& row : rows) change += row.work;
  std::erase_if(rows, [](const EnergyRow& row) { return row.work == 0; });
  std::ranges::stable_sort(rows, [](const EnergyRow& a, const EnergyRow& b) {
    return std::abs(a.work) > std::abs(b.work);
  });
  std::string text = " ";
  for (std::size_t i = 0; i < std::min(rows.size(), kMaxRows); ++i)
    text += fmt::format(" {} {},", rows[i].name, cell(rows[i].work));
  if (rows.size() > kMaxRows) text += fmt::format(" {} smaller rows,", rows.size() - kMaxRows);
  sheet.title("ENERGY BALANCE since the start of the run: work [J]", "largest first");
  sheet.line(wrapped(text + fmt::format(" sum = change of kinetic energy {}", cell(change))));
}

void write_balances(JsonWriter& json, const Inspection& in, const InspectView& view) {
  json.list(view.bodies, [&](const std::size_t body) {
    const BodyBalance balance = balance_of(in, body, view.from);
    const auto write_wrenches = [&] {
      json.list(balance.wrenches, [&](const NamedWrench& wrench) {
        json.object(
            {{"source", wrench.source}, {"force", wrench.force}, {"torque", wrench.torque}});
      });
    };
    json.object({{"body", in.model.body_name[body]},
                 {"about", view.from.p_WV(in, body)},
                 {"wrenches", write_wrenches},
                 {"largest", balance.largest},
                 {"residual", balance.residual}});
  });
}

void write_joints(JsonWriter& json, const Inspection& in, const InspectView& view) {
  json.list(joint_balances(in), [&](const JointBalance& joint) {
    if (std::ranges::find(view.bodies, joint.body) == view.bodies.end()) return;
    json.begin_object();
    json.members({{"joint", in.model.joint_name[joint.body]},
                  {"component", joint.dof - in.model.iv[joint.body]},
                  {"unit", unit_at_joint(in.model, joint.body, "N m; N")}});
    json.key("torques").list(joint.torques, [&](const JointBalance::Torque& torque) {
      json.object({{"source", torque.source}, {"value", torque.value}});
    });
    json.key("residual").number(joint.residual);
    json.end_object();
  });
}

void write_checks(JsonWriter& json, const std::vector<Check>& checks) {
  json.list(checks, [&](const Check& check) {
    json.object({{"name", check.name},
                 {"meaning", check.meaning},
                 {"error", check.error},
                 {"tolerance", check.tolerance},
                 {"body", check.worst},
                 {"pass", check.pass()}});
  });
}

}  // namespace

std::string inspect_text(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks) {
  Sheet sheet;
  sheet.line(view.title);
  if (!view.forces_alone) {
    sheet.line("Spatial vectors: angular | linear, in the link's axes, about the link's origin.");
    const ReferenceErrors errors = reference_errors(in);
    for (const int pass : view.passes) write_bodies(in, view, pass, errors, sheet);
    write_balances(in, view, sheet);
  }
  write_named_forces(in, view, sheet);
  if (!view.forces_alone) write_energy_balance(view.energy_balance, sheet);
  write_checks(checks, sheet);
  return sheet.str();
}

void write_value(JsonWriter& json, const Eigen::MatrixXd& m, bool by_columns) {
  if (m.cols() == 1)
    json.number_or_list({m.data(), m.data() + m.size()});
  else
    json.matrix(by_columns ? Eigen::MatrixXd(m.transpose()) : m);
}

void write_quantities(JsonWriter& json, const std::vector<DisplayedQuantity>& quantities) {
  json.list(quantities, [&](const DisplayedQuantity& shown) {
    const bool by_columns = shown.quantity.by == Quantity::By::velocity;
    json.object({{"name", shown.quantity.name},
                 {"meaning", shown.quantity.meaning},
                 {"unit", shown.unit},
                 {"frame", shown.frame},
                 {"equation", shown.quantity.equation},
                 {"value", [&] { write_value(json, shown.value, by_columns); }}});
  });
}

void write_passes(JsonWriter& json, const Inspection& in, const std::vector<int>& passes,
                  const std::vector<std::size_t>& bodies) {
  json.list(passes, [&](const int pass) {
    std::vector<std::size_t> order = bodies;
    if (pass == 2) order.assign(bodies.rbegin(), bodies.rend());
    for (const std::size_t body : order)
      json.object(
          {{"pass", pass},
           {"body", in.model.body_name[body]},
           {"joint", in.model.joint_name[body]},
           {"quantities", [&] { write_quantities(json, shown_quantities(in, pass, body)); }}});
  });
}

void write_forces(JsonWriter& json, const Inspection& in, const InspectView& view) {
  json.list(forces_in_view(in, view), [&](const NamedForce& named) {
    json.begin_object();
    json.key("source").text(named.force->source);
    if (named.force->point_W) json.key("point").vector(*named.force->point_W);
    if (named.force->normal_W) json.key("axis").vector(*named.force->normal_W);
    if (named.parts)
      json.members({{"normal", named.parts->normal}, {"friction", named.parts->friction}});
    if (named.force->is_interaction) json.put("unique", named.force->is_unique);
    json.key("on").list(named.ends, [&](const NamedForce::End& end) {
      json.object({{"body", in.model.body_name[end.body]},
                   {"force", end.wrench.force},
                   {"torque", end.wrench.torque},
                   {"about", end.about}});
    });
    json.key("joints").list(named.joints, [&](const NamedForce::OnJoint& on) {
      json.object({{"joint", in.model.joint_name[on.body]},
                   {"component", on.dof - in.model.iv[on.body]},
                   {"value", on.value}});
    });
    json.end_object();
  });
}

void write_inspection(JsonWriter& json, const Inspection& in, const InspectView& view,
                      const std::vector<Check>& checks) {
  write_passes(json.key("passes"), in, view.passes, view.bodies);
  write_balances(json.key("balance"), in, view);
  write_joints(json.key("joint_balance"), in, view);
  write_forces(json.key("forces"), in, view);
  write_checks(json.key("checks"), checks);
  if (!view.energy_balance.empty()) {
    json.key("energy_balance").object([&] {
      for (const EnergyRow& row : view.energy_balance) json.put(row.name, row.work);
    });
  }
  json.members({{"axes", view.axes}, {"about", view.about}, {"warnings", view.warnings}});
}

std::string inspect_json(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks) {
  return answer_text([&](JsonWriter& json) { write_inspection(json, in, view, checks); });
}

}  // namespace twinarm
