#include "app/inspect/report/pass_words.h"

#include <fmt/format.h>

#include <cmath>

#include "app/inspect/report/pass_pages.h"

namespace twinarm {

std::string name_of_number(const Eigen::VectorXd& v) {
  if (v.size() == 1) return short_number(v[0], std::abs(v[0]));
  std::string text = "(";
  for (Eigen::Index k = 0; k < v.size(); ++k)
    text += (k ? ", " : "") + short_number(v[k], v.lpNorm<Eigen::Infinity>());
  return text + ")";
}

std::string subtracted(double value, double scale) {
  const std::string text = short_number(value, scale);
  return text[0] == '-' ? "(" + text + ")" : text;
}

std::string of_parent(const Inspection& in, std::size_t body) {
  return in.parent(body) == 0 ? "_base" : "_p";
}

const char* joint_unit(const Inspection& in, std::size_t body, const char* turn,
                       const char* shift) {
  if (in.model.dofs(body) > 1) return "";
  return in.model.joint[body] == JointType::prismatic ? shift : turn;
}

void write_columns(Sheet& sheet, const char* name, const Eigen::MatrixXd& columns,
                   const Vector6& size) {
  for (Eigen::Index k = 0; k < columns.cols(); ++k)
    sheet.row(columns.cols() == 1 ? std::string(name) : fmt::format("{}[{}]", name, k + 1),
              columns.col(k), size);
}

void write_body_head(const Inspection& in, std::size_t i, Sheet& sheet) {
  const std::string& joint = in.model.joint_name[i];
  std::string text = "\n" + in.model.body_name[i];
  text += fmt::format(", carried by {} ({}) on {}", joint.empty() ? "the base" : joint,
                      name_of(in.model.joint[i]), in.model.body_name[in.parent(i)]);
  if (in.model.dofs(i) == 1) {
    const char* unit = joint_unit(in, i, "rad", "m");
    text += fmt::format("    q = {} {}, qd = {} {}/s", short_number(in.x.q[in.model.iq[i]]), unit,
                        short_number(in.x.qd[in.model.iv[i]]), unit);
  }
  sheet.line(text);
}

}  // namespace twinarm
