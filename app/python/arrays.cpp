#include "app/python/arrays.h"

#include "app/support/files.h"
#include "solver/support/number_text.h"

namespace twinarm::python {

std::string shape_text(const py::ssize_t* shape, py::ssize_t dimensions) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < dimensions; ++i)
    text += (i > 0 ? ", " : "") + std::to_string(shape[i]);
  return text + (dimensions == 1 ? ",)" : ")");
}

Array numbers_of(const py::handle& given, const std::string& what) {
  Array numbers = Array::ensure(given);
  if (numbers) return numbers;
  throw py::type_error(what + " must be an array of real numbers, is a " +
                       std::string(py::str(py::type::handle_of(given).attr("__name__"))));
}

void check_finite(const double* numbers, std::size_t count, const std::string& what) {
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(numbers[i]))
      throw py::value_error(what + "[" + std::to_string(i) + "] is " + number_text(numbers[i]) +
                            "; give finite numbers");
}

std::vector<double> vector_of(const py::handle& given, std::size_t size, const std::string& what,
                              const std::string& why) {
  const Array numbers = numbers_of(given, what);
  if (numbers.ndim() != 1 || static_cast<std::size_t>(numbers.size()) != size)
    throw py::value_error(what + " has shape " + shape_text(numbers) + ", must have (" +
                          std::to_string(size) + ",): " + why);
  check_finite(numbers.data(), size, what);
  return {numbers.data(), numbers.data() + size};
}

std::filesystem::path path_of(const py::handle& file) {
  const auto name = py::cast<std::string>(py::module_::import("os").attr("fspath")(file));
  if (name.empty() || name.find('\0') != name.npos)
    throw py::value_error("the name of a file is empty or has a null byte");
  return find_input(name);
}

Array array_of(const std::vector<double>& values) {
  return Array(static_cast<py::ssize_t>(values.size()), values.data());
}

Array frozen(const std::vector<double>& values) {
  Array copy = array_of(values);
  copy.attr("flags").attr("writeable") = false;
  return copy;
}

Array zeros(const std::vector<py::ssize_t>& shape) {
  Array array(shape);
  std::fill_n(array.mutable_data(), array.size(), 0.0);
  return array;
}

}  // namespace twinarm::python
