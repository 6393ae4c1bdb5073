// What the last aba() of a model left, by name, in link axes.
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/inspect/inspection.h"
#include "app/python/arrays.h"
#include "app/python/robots.h"
#include "app/support/text.h"
#include "solver/model/field_description.h"

namespace twinarm::python {
namespace {

// A copy: later calls do not change it.
struct Left {
  Quantity quantity;
  const char* frame;
  Array value;
};
struct LeftByAba {
  std::vector<Left> all;
};
std::vector<std::string> names_of(const LeftByAba& left) {
  std::vector<std::string> names;
  for (const Left& one : left.all) names.emplace_back(one.quantity.name);
  return names;
}
Array value_of(const LeftByAba& left, const std::string& name) {
  for (const Left& one : left.all)
    if (one.quantity.name == name) return one.value;
  throw py::key_error("there is no quantity '" + name + "'; " +
                      name_remedy(name, names_of(left), "quantities"));
}

class Collector {
 public:
  Collector(const Robot& robot, LeftByAba& left)
      : robot_(robot), model_(robot.model), left_(left) {}

  void operator()(const Quantity& quantity, const std::vector<double>& field) {
    if (quantity.by == Quantity::By::square) return add(quantity, kJointFrame, square(field));
    add(quantity, kJointFrame, array_of(field));
  }
  template <class T>
  void operator()(const Quantity& quantity, const std::vector<T>& field) {
    constexpr bool kIsVector =
        std::is_same_v<T, Motion<double>> || std::is_same_v<T, Force<double>>;
    const auto rows = static_cast<py::ssize_t>(field.size());
    Array value = kIsVector ? zeros({rows, 6}) : zeros({rows, 6, 6});
    double* at = value.mutable_data();
    const std::size_t size = kIsVector ? 6 : 36;
    for (std::size_t i = 0; i < model_.parent.size(); ++i) {
      if (quantity.by == Quantity::By::body) {
        // The base has no quantities but its acceleration, by which gravity comes in.
        if (i > 0 || quantity.pass == 3) write_of(i, field[i], at + i * size);
      } else if (i > 0) {
        for (std::size_t k = model_.iv[i]; k < model_.iv[i] + model_.dofs(i); ++k)
          write_of(i, field[k], at + k * size);
      }
    }
    add(quantity, std::is_same_v<T, Transform<double>> ? kParentToLinkFrame : kLinkFrame,
        std::move(value));
  }

 private:
  template <class T>
  void write_of(std::size_t i, const T& entry, double* at) const {
    const auto shown = LinkFrame(model_, i).show(entry);
    for (Eigen::Index r = 0; r < shown.rows(); ++r)
      for (Eigen::Index c = 0; c < shown.cols(); ++c) *at++ = shown(r, c);
  }
  // nv x nv, the square of each joint on the diagonal.
  Array square(const std::vector<double>& field) const {
    const auto nv = static_cast<py::ssize_t>(model_.nv);
    Array all = zeros({nv, nv});
    for (std::size_t i = 1; i < model_.parent.size(); ++i)
      for (std::size_t r = 0; r < model_.dofs(i); ++r)
        for (std::size_t c = 0; c < model_.dofs(i); ++c)
          *all.mutable_data(static_cast<py::ssize_t>(model_.iv[i] + r),
                            static_cast<py::ssize_t>(model_.iv[i] + c)) =
              field[robot_.of_aba.iD[i] + r * model_.dofs(i) + c];
    return all;
  }
  void add(const Quantity& quantity, const char* frame, Array value) {
    value.attr("flags").attr("writeable") = false;
    left_.all.push_back({quantity, frame, std::move(value)});
  }

  const Robot& robot_;
  const Model<double>& model_;
  LeftByAba& left_;
};

LeftByAba left_by_aba(const Robot& robot) {
  if (!robot.has_run_aba)
    throw std::runtime_error(
        "model.workspace(): nothing has been computed with this model; call twinarm.aba(model, q, "
        "qd, tau) first");
  LeftByAba left;
  Collector collect(robot, left);
  robot.forces.describe(collect);
  robot.of_aba.describe(collect);
  return left;
}

py::list described(const LeftByAba& left) {
  py::list table;
  for (const auto& [quantity, frame, value] : left.all) {
    py::dict row;
    row["name"] = quantity.name;
    row["pass"] = quantity.pass;
    row["shape"] = value.attr("shape");
    row["unit"] = quantity.unit;
    row["frame"] = frame;
    row["meaning"] = quantity.meaning;
    row["equation"] = quantity.equation;
    table.append(row);
  }
  return table;
}

std::string text_of(const LeftByAba& left) {
  std::string text = "name       pass   shape        unit                      equation\n";
  for (const auto& [quantity, frame, value] : left.all) {
    char line[256];
    const std::string pass = quantity.pass == 0 ? "input" : std::to_string(quantity.pass);
    std::snprintf(line, sizeof line, "%-10s %-6s %-12s %-25s %s\n", quantity.name, pass.c_str(),
                  shape_text(value).c_str(), quantity.unit, quantity.equation);
    text += line;
  }
  return text;
}

}  // namespace

void add_workspace(py::module_& m) {
  py::class_<LeftByAba> workspace(
      m, "Workspace",
      "What the last aba() of a model left, by the names of RBDA table 7.1: ws['IA'], ws['pA'], "
      "...\n"
      "A copy, in link axes; describe() says what each is. Rows are bodies, the base first, or\n"
      "joint velocities. Of the base there is only its acceleration a = -g.");
  workspace.def(
      "__getitem__", value_of, py::arg("name"),
      "By body: vectors (bodies, 6), inertias and transforms (bodies, 6, 6). By velocity: (nv,),\n"
      "(nv, 6). D is (nv, nv). Units as in describe(). Raises KeyError for another name.");
  workspace.def(
      "__contains__",
      [](const LeftByAba& left, const std::string& name) {
        return std::ranges::any_of(left.all,
                                   [&](const Left& one) { return one.quantity.name == name; });
      },
      py::arg("name"), "whether there is a quantity of that name");
  workspace.def(
      "__len__", [](const LeftByAba& left) { return left.all.size(); }, "how many quantities");
  workspace.def("keys", names_of, "names, in the order in which aba() needs and finds them");
  workspace.def(
      "__iter__", [](const LeftByAba& left) { return py::iter(py::cast(names_of(left))); },
      "over the names");
  workspace.def("describe", described,
                "A row for each quantity: name, pass (0: input), shape, unit (angular; linear),\n"
                "frame, meaning, equation. As the solver itself states them.");
  workspace.def("__repr__", text_of);

  py::reinterpret_borrow<py::class_<Robot, std::shared_ptr<Robot>>>(m.attr("Model"))
      .def(
          "workspace", left_by_aba,
          "What the last aba() with this model left: a Workspace, whose describe() has the units.");
}

}  // namespace twinarm::python
