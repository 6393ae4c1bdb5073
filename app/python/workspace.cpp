// Quantities of the last aba() of a model, by name, in link axes.
#include <pybind11/stl.h>

#include <cstdio>

#include "app/inspect/inspection.h"
#include "app/python/arrays.h"
#include "app/python/robots.h"
#include "app/support/text.h"

namespace twinarm::python {
namespace {

// A copy of one quantity.
struct SavedQuantity {
  Quantity quantity;
  const char* frame;
  Array value;
};
struct AbaQuantities : OnlyConstructed {
  std::vector<SavedQuantity> all;
};
std::vector<std::string> names_of(const AbaQuantities& saved) {
  std::vector<std::string> names;
  for (const SavedQuantity& one : saved.all) names.emplace_back(one.quantity.name);
  return names;
}
Array value_of(const AbaQuantities& saved, const std::string& name) {
  for (const SavedQuantity& one : saved.all)
    if (one.quantity.name == name) return one.value;
  throw py::key_error("there is no quantity '" + name + "'; " +
                      name_remedy(name, names_of(saved), "quantities"));
}

class Collector {
 public:
  Collector(const Robot& robot, AbaQuantities& saved)
      : robot_(robot), model_(robot.model), saved_(saved) {}

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
        // The base has only its acceleration, -g.
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
    saved_.all.push_back({quantity, frame, std::move(value)});
  }

  const Robot& robot_;
  const Model<double>& model_;
  AbaQuantities& saved_;
};

std::shared_ptr<AbaQuantities> aba_quantities(const Robot& robot) {
  if (!robot.has_run_aba)
    throw std::runtime_error("model.workspace(): call twinarm.aba(model, q, qd, tau) first");
  auto saved = std::make_shared<AbaQuantities>();
  Collector collect(robot, *saved);
  robot.forces.describe(collect);
  robot.of_aba.describe(collect);
  return saved;
}

py::list described(const AbaQuantities& saved) {
  py::list table;
  for (const auto& [quantity, frame, value] : saved.all) {
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

std::string text_of(const AbaQuantities& saved) {
  std::string text = "name       pass   shape        unit                      equation\n";
  for (const auto& [quantity, frame, value] : saved.all) {
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
  py::class_<AbaQuantities, std::shared_ptr<AbaQuantities>> workspace(
      m, "Workspace",
      "Quantities of the last aba(), by the names of RBDA table 7.1: ws['IA'], ws['pA'], ...\n"
      "A copy, in link axes; describe() lists them. Rows are bodies, the base first, or joint\n"
      "velocities. The base has only its acceleration a = -g.");
  workspace.def(
      "__getitem__", value_of, py::arg("name"),
      "By body: vectors (bodies, 6), inertias and transforms (bodies, 6, 6). By velocity: (nv,),\n"
      "(nv, 6). D is (nv, nv). Units as in describe(). Raises KeyError for another name.");
  workspace.def(
      "__contains__",
      [](const AbaQuantities& saved, const std::string& name) {
        return std::ranges::any_of(
            saved.all, [&](const SavedQuantity& one) { return one.quantity.name == name; });
      },
      py::arg("name"), "whether the quantity exists");
  workspace.def(
      "__len__", [](const AbaQuantities& saved) { return saved.all.size(); },
      "number of quantities");
  workspace.def("keys", names_of, "names, in the order of aba()");
  workspace.def(
      "__iter__", [](const AbaQuantities& saved) { return py::iter(py::cast(names_of(saved))); },
      "over the names");
  workspace.def("describe", described,
                "A row for each quantity: name, pass (0: input), shape, unit (angular; linear),\n"
                "frame, meaning, equation, from the solver.");
  workspace.def("__repr__", text_of);

  py::reinterpret_borrow<py::class_<Robot, std::shared_ptr<Robot>>>(m.attr("Model"))
      .def("workspace", aba_quantities,
           "Quantities of the last aba() with this model; units: describe().");
}

}  // namespace twinarm::python
