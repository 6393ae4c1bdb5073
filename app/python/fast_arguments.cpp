#include "app/python/fast_arguments.h"

namespace twinarm::python {
namespace {

using py::detail::npy_api;

// numpy's descriptor of float64.
PyObject* doubles() {
  static PyObject* const type = npy_api::get().PyArray_DescrFromType_(npy_api::NPY_DOUBLE_);
  return type;
}
bool is_plain(PyObject* given, int flags) {
  if (Py_TYPE(given) != npy_api::get().PyArray_Type_) return false;
  const auto* array = py::detail::array_proxy(given);
  return array->descr == doubles() && (array->flags & flags) == flags;
}

// Non-finite numbers have all exponent bits set.
bool all_finite(const double* numbers, std::size_t count) {
  constexpr std::uint64_t kExponent = 0x7FF0000000000000;
  bool finite = true;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t bits;
    std::memcpy(&bits, numbers + i, sizeof bits);
    finite &= (bits & kExponent) != kExponent;
  }
  return finite;
}

}  // namespace

Robot& robot_of(const char* function, PyObject* given) {
  static const py::handle type = py::type::of<Robot>();
  if (Py_TYPE(given) != reinterpret_cast<PyTypeObject*>(type.ptr()))
    throw py::type_error(std::string(function) + "(): model must be a twinarm.Model, is a " +
                         Py_TYPE(given)->tp_name);
  auto* instance = reinterpret_cast<py::detail::instance*>(given);
  auto* robot = static_cast<Robot*>(instance->get_value_and_holder().value_ptr());
  if (!robot)
    throw py::type_error(std::string(function) + "(): create the model with twinarm.load()");
  return *robot;
}

Rows::Rows(const char* function, const char* name, PyObject* given, std::size_t size,
           const Robot& robot)
    : function_(function), name_(name), size_(size) {
  if (!is_plain(given, npy_api::NPY_ARRAY_C_CONTIGUOUS_ | npy_api::NPY_ARRAY_ALIGNED_)) {
    kept_ = numbers_of(given, std::string(function) + "(): " + name);
    given = kept_.ptr();
  }
  const auto* array = py::detail::array_proxy(given);
  check_shape(array->nd, array->dimensions, robot);
  data_ = reinterpret_cast<const double*>(array->data);
}

void Rows::check_shape(int dimensions, const py::ssize_t* shape, const Robot& robot) {
  is_one_ = dimensions == 1;
  if ((dimensions == 1 || dimensions == 2) &&
      static_cast<std::size_t>(shape[dimensions - 1]) == size_) {
    count_ = is_one_ ? 1 : static_cast<std::size_t>(shape[0]);
    return;
  }
  const std::string wanted = std::to_string(size_);
  throw py::value_error(std::string(function_) + "(): " + name_ + " has shape " +
                        shape_text(shape, dimensions) + ", must have (" + wanted + ",) or (N, " +
                        wanted + "): the model has " + robot.size_of_q() + " and " +
                        robot.size_of_qd());
}

void Rows::copy(std::size_t row, std::vector<double>& to) const {
  const double* from = data_ + (is_one_ ? 0 : row * size_);
  if (!all_finite(from, size_))
    check_finite(
        from, size_,
        std::string(function_) + "(): " + name_ + (is_one_ ? "" : "[" + std::to_string(row) + "]"));
  std::copy_n(from, size_, to.data());
}

Calls::Calls(const char* function, std::initializer_list<const Rows*> all) {
  for (const Rows* rows : all) {
    if (rows->is_one()) continue;
    if (!is_one && rows->count() != count)
      throw py::value_error(std::string(function) + "(): one argument has " +
                            std::to_string(count) + " rows, another " +
                            std::to_string(rows->count()) +
                            "; give the same number, or one vector");
    is_one = false;
    count = rows->count();
  }
}

Output::Output(const char* function, PyObject* given, const Calls& calls,
               std::initializer_list<std::size_t> shape) {
  std::array<py::ssize_t, 3> dimensions{};
  int n = 0;
  if (!calls.is_one)
    dimensions[static_cast<std::size_t>(n++)] = static_cast<py::ssize_t>(calls.count);
  for (const std::size_t extent : shape) {
    dimensions[static_cast<std::size_t>(n++)] = static_cast<py::ssize_t>(extent);
    size_ *= extent;
  }
  const npy_api& api = npy_api::get();
  if (!given) {
    Py_INCREF(doubles());  // stolen by the next call
    kept_ = py::reinterpret_steal<py::object>(api.PyArray_NewFromDescr_(
        api.PyArray_Type_, doubles(), n, dimensions.data(), nullptr, nullptr, 0, nullptr));
    if (!kept_) throw py::error_already_set();
  } else {
    constexpr int kWanted = npy_api::NPY_ARRAY_C_CONTIGUOUS_ | npy_api::NPY_ARRAY_ALIGNED_ |
                            npy_api::NPY_ARRAY_WRITEABLE_;
    const bool is_array = is_plain(given, kWanted);
    const auto* array = py::detail::array_proxy(given);
    if (!is_array || array->nd != n ||
        !std::equal(dimensions.begin(), dimensions.begin() + n, array->dimensions))
      throw py::value_error(std::string(function) + "(): out must be a writeable array of shape " +
                            shape_text(dimensions.data(), n) +
                            ", float64, C-contiguous, as from numpy.empty");
    kept_ = py::reinterpret_borrow<py::object>(given);
  }
  data_ = reinterpret_cast<double*>(py::detail::array_proxy(kept_.ptr())->data);
}

}  // namespace twinarm::python
