#include "collision/shapes/shape.h"

#include <cmath>

#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

[[noreturn]] void refuse_solid(const std::string& problem, const char* fix) {
  throw InputError("mass properties", problem, fix, "shape.mass");
}

std::string positive(const char* name, double value) {
  if (value > 0 && std::isfinite(value)) return "";
  return std::string(name) + " is " + short_number_text(value) + " m, must be positive";
}
std::string positive(const char* name, const Vector3& values) {
  for (const double value : values)
    if (const std::string fault = positive(name, value); !fault.empty()) return fault;
  return "";
}

template <class S>
std::string fault_of(const S& shape) {
  if constexpr (requires { shape.fault(); }) {
    return shape.fault();
  } else {
    std::string first;
    for_each_length(shape, [&](const char* name, const auto& value) {
      if (first.empty()) first = positive(name, value);
    });
    return first;
  }
}

}  // namespace

Vector3 support(const Shape& shape, const Vector3& direction) {
  return std::visit([&](const auto& s) { return Vector3(s.support(direction)); }, shape);
}

std::string shape_fault(const Shape& shape) {
  return std::visit([](const auto& s) { return fault_of(s); }, shape);
}

std::string shape_name(const Shape& shape) {
  return std::visit([](const auto& s) { return s.name; }, shape);
}

Polytope make_polytope(const Shape& shape) {
  return std::visit(
      [](const auto& s) {
        if constexpr (requires { s.polytope(); }) {
          return s.polytope();
        } else {
          Polytope none;
          none.exists = false;
          return none;
        }
      },
      shape);
}

BoundaryFeatures make_boundary(const Shape& shape, const Polytope& core) {
  return std::visit(
      [&](const auto& s) {
        if constexpr (requires { s.boundary(); })
          return s.boundary();
        else
          return make_boundary(core);
      },
      shape);
}

MassProperties mass_properties(const Shape& shape, double density) {
  check_density(density);
  const std::string fault = shape_fault(shape);
  if (!fault.empty()) refuse_solid(shape_name(shape) + ": " + fault, "correct the shape");
  return std::visit(
      [&](const auto& s) -> MassProperties {
        if constexpr (requires { s.solid(density); })
          return s.solid(density);
        else
          refuse_solid(std::string("a ") + s.name + " encloses no solid",
                       "give the inertia of its body");
      },
      shape);
}

}  // namespace twinarm
