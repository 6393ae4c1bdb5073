#include "app/python/robots.h"

#include <utility>

#include "app/python/arrays.h"
#include "app/record/unpack.h"
#include "solver/support/number_text.h"

namespace twinarm::python {
namespace {

std::string name_of(const std::string& path) {
  return "set['" + path + "']";
}

// VALUE as for `twinarm replay --set PATH=VALUE`.
std::string setting_text(const std::string& path, const py::handle& value) {
  if (py::isinstance<py::str>(value)) return py::cast<std::string>(value);
  if (py::isinstance<py::bool_>(value)) return py::cast<bool>(value) ? "true" : "false";
  const std::string what = name_of(path);
  const Array numbers = numbers_of(value, what);
  check_finite(numbers.data(), static_cast<std::size_t>(numbers.size()), what);
  if (numbers.ndim() > 1 || numbers.size() == 0)
    throw py::value_error(what + " must be a number, a text, a flag or a list of numbers");
  std::string text;
  for (py::ssize_t i = 0; i < numbers.size(); ++i)
    text += (i > 0 ? "," : "") + number_text(numbers.data()[i]);
  return text;
}

}  // namespace

void change_scene(const py::object& set, SimulateOptions& options) {
  if (set.is_none()) return;
  if (options.robot.model.extension() != ".toml")
    throw py::value_error("set= changes a scene; '" + options.robot.model.string() +
                          "' is not a scene: write one that contains the robot");
  DiagnosticList faults;
  Value scene = read_toml(options.robot.model);
  for (const auto& [path, value] : py::cast<py::dict>(set)) {
    const Change change{py::cast<std::string>(path),
                        setting_text(py::cast<std::string>(path), value)};
    DiagnosticList of_change;  // names the command line option
    apply(change, 0, scene, of_change);
    for (Diagnostic fault : of_change.faults()) {
      fault.where = name_of(change.path);
      faults.add(std::move(fault));
    }
  }
  faults.check();
  options.scene = std::move(scene);
}

}  // namespace twinarm::python
