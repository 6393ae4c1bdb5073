#include <algorithm>

#include "app/data/json_writer.h"
#include "app/inspect/displayed_quantities.h"
#include "app/inspect/report/inspect_output.h"

namespace twinarm {
namespace {

std::vector<double> list_of(const Eigen::MatrixXd& column) {
  return {column.data(), column.data() + column.size()};
}

// A number alone; six numbers; a list of columns where a joint has several; else a matrix by rows.
void write_value(JsonWriter& json, const Shown& shown) {
  using By = Quantity::By;
  const Eigen::MatrixXd& m = shown.value;
  if (m.cols() == 1) return json.number_or_list(list_of(m));
  if (shown.quantity.by != By::velocity) return json.matrix(m);
  json.begin_array();
  for (Eigen::Index c = 0; c < m.cols(); ++c) json.vector(m.col(c));
  json.end_array();
}

void write_balances(JsonWriter& json, const Inspection& in, const InspectView& view) {
  json.begin_array();
  for (const std::size_t body : view.bodies) {
    const BodyBalance balance = balance_of(in, body, view.from);
    json.begin_object();
    json.key("body").text(in.model.body_name[body]);
    json.key("about").vector(view.from.p_WV(in, body));
    json.key("wrenches").begin_array();
    for (const NamedWrench& wrench : balance.wrenches) {
      json.begin_object();
      json.key("source").text(wrench.source);
      json.key("force").vector(wrench.force);
      json.key("torque").vector(wrench.torque);
      json.end_object();
    }
    json.end_array();
    json.key("largest").number(balance.largest);
    json.key("residual").number(balance.residual);
    json.end_object();
  }
  json.end_array();
}

void write_forces(JsonWriter& json, const Inspection& in, const InspectView& view) {
  json.begin_array();
  for (const NamedForce& named : forces_in_view(in, view)) {
    json.begin_object();
    json.key("source").text(named.source);
    if (named.point) json.key("point").vector(*named.point);
    if (named.normal) json.key("axis").vector(*named.normal);
    if (named.parts) {
      json.key("normal").number(named.parts->normal);
      json.key("friction").number(named.parts->friction);
    }
    json.key("on").begin_array();
    for (const NamedForce::End& end : named.ends) {
      json.begin_object();
      json.key("body").text(in.model.body_name[end.body]);
      json.key("force").vector(end.wrench.force);
      json.key("torque").vector(end.wrench.torque);
      json.key("about").vector(end.about);
      json.end_object();
    }
    json.end_array();
    json.key("joints").begin_array();
    for (const NamedForce::OnJoint& on : named.joints) {
      json.begin_object();
      json.key("joint").text(in.model.joint_name[on.body]);
      json.key("component").count(static_cast<long>(on.dof - in.model.iv[on.body]));
      json.key("value").number(on.value);
      json.end_object();
    }
    json.end_array();
    json.end_object();
  }
  json.end_array();
}

void write_joints(JsonWriter& json, const Inspection& in, const InspectView& view) {
  json.begin_array();
  for (const JointBalance& joint : joint_balances(in)) {
    if (std::find(view.bodies.begin(), view.bodies.end(), joint.body) == view.bodies.end())
      continue;
    json.begin_object();
    json.key("joint").text(in.model.joint_name[joint.body]);
    json.key("component").count(static_cast<long>(joint.dof - in.model.iv[joint.body]));
    json.key("torques").begin_array();
    for (const JointBalance::Torque& torque : joint.torques) {
      json.begin_object();
      json.key("source").text(torque.source);
      json.key("value").number(torque.value);
      json.end_object();
    }
    json.end_array();
    json.key("residual").number(joint.residual);
    json.end_object();
  }
  json.end_array();
}

void write_checks(JsonWriter& json, const std::vector<Check>& checks) {
  json.begin_array();
  for (const Check& check : checks) {
    json.begin_object();
    json.key("name").text(check.name);
    json.key("meaning").text(check.meaning);
    json.key("error").number(check.error);
    json.key("tolerance").number(check.tolerance);
    json.key("body").text(check.worst);
    json.key("pass");
    json.boolean(check.pass());
    json.end_object();
  }
  json.end_array();
}

}  // namespace

void write_quantities(JsonWriter& json, const std::vector<Shown>& quantities) {
  json.begin_array();
  for (const Shown& shown : quantities) {
    json.begin_object();
    json.key("name").text(shown.quantity.name);
    json.key("meaning").text(shown.quantity.meaning);
    json.key("unit").text(shown.quantity.unit);
    json.key("frame").text(shown.frame);
    json.key("equation").text(shown.quantity.equation);
    write_value(json.key("value"), shown);
    json.end_object();
  }
  json.end_array();
}

void write_passes(JsonWriter& json, const Inspection& in, const std::vector<int>& passes,
                  const std::vector<std::size_t>& bodies) {
  json.begin_array();
  for (const int pass : passes) {
    std::vector<std::size_t> order = bodies;
    if (pass == 2) order.assign(bodies.rbegin(), bodies.rend());
    for (const std::size_t body : order) {
      json.begin_object();
      json.key("pass").count(pass);
      json.key("body").text(in.model.body_name[body]);
      json.key("joint").text(in.model.joint_name[body]);
      write_quantities(json.key("quantities"), shown_quantities(in, pass, body));
      json.end_object();
    }
  }
  json.end_array();
}

void write_inspection(JsonWriter& json, const Inspection& in, const InspectView& view,
                      const std::vector<Check>& checks) {
  write_passes(json.key("passes"), in, view.passes, view.bodies);
  write_balances(json.key("balance"), in, view);
  write_joints(json.key("joint_balance"), in, view);
  write_forces(json.key("forces"), in, view);
  write_checks(json.key("checks"), checks);
  if (!view.ledger.empty()) {
    json.key("ledger").begin_object();
    for (const LedgerRow& row : view.ledger) json.key(row.name).number(row.work);
    json.end_object();
  }
  json.key("axes").text(view.axes);
  json.key("about").text(view.about);
  json.key("warnings").texts(view.warnings);
}

std::string inspect_json(const Inspection& in, const InspectView& view,
                         const std::vector<Check>& checks) {
  JsonWriter json;
  json.begin_object();
  write_inspection(json, in, view, checks);
  json.end_object();
  return json.str();
}

}  // namespace twinarm
