// The shapes, each in its geometry frame G (pose X_WG), and functions of all of them.
//
// To add a shape with a few dimensions: a file such as cylinder.h, included here, with its number
// (shape_number.h). It must have
//   name, key            in messages and in files: "spherical cavity", "spherical_cavity"
//   lengths()            its dimensions in files: doubles and Vector3, all > 0
//   support(d)           support point in direction d (d != 0): maximises d . x
// and either polytope(), a polyhedron with a radius, or boundary(), its smooth features. It may
// have
//   solid(density)       mass properties; without it, it encloses nothing
//   is_in_urdf           URDF has it, as <key length_1 ..>
//   nearest(p)           closed-form distance from a point: exact contacts with spheres
//   plane_contact_points the points that can touch a plane, if it is curved
// Robots and scenes then read and write it, it is drawn as its hull, and it collides with all
// convex shapes, half-spaces and meshes; a polyhedron also with cavities.
#pragma once

#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "collision/geometry/convex_hull.h"
#include "collision/geometry/mass_properties.h"
#include "collision/shapes/box.h"
#include "collision/shapes/capsule.h"
#include "collision/shapes/cavity.h"
#include "collision/shapes/cylinder.h"
#include "collision/shapes/ellipsoid.h"
#include "collision/shapes/half_space.h"
#include "collision/shapes/mesh_shape.h"
#include "collision/shapes/sphere.h"

namespace twinarm {

// Default values of all numbered shapes, from `number` on.
template <int number = 0>
constexpr auto numbered_shapes() {
  if constexpr (requires { numbered(ShapeNumber<number>()); })
    return std::tuple_cat(std::tuple<decltype(numbered(ShapeNumber<number>()))>(),
                          numbered_shapes<number + 1>());
  else
    return std::tuple<>();
}
template <class... Numbered, class... Others>
std::variant<Numbered..., Others...> one_of(const std::tuple<Numbered...>&, const Others&...);

// The numbered shapes and others.
template <class... Others>
using AnyShape = decltype(one_of(numbered_shapes(), std::declval<Others>()...));
using Shape = AnyShape<ConvexHull, MeshShape>;

// Support point; of a cavity that of the solid that fills it.
Vector3 support(const Shape& shape, const Vector3& direction);

// Error in the dimensions, e.g. "radius is -1 m, must be positive"; empty if valid.
std::string shape_fault(const Shape& shape);

std::string shape_name(const Shape& shape);

// `exists` is false for curved shapes and half-spaces.
Polytope make_polytope(const Shape& shape);

// Empty for shapes that are not convex or not bounded.
BoundaryFeatures make_boundary(const Shape& shape, const Polytope& core);

// Of a solid of constant `density` [kg/m^3]. Throws InputError for an invalid shape, and for
// half-spaces and cavities.
MassProperties mass_properties(const Shape& shape, double density);

// Calls f(name, value) for each dimension [m], a double or Vector3.
template <class S, class F>
void for_each_length(S& shape, F f) {
  std::apply([&](const auto&... of) { (f(of.first, shape.*of.second), ...); },
             std::remove_const_t<S>::lengths());
}

// Calls f(shape) for the default value of each numbered shape, in order.
template <class F>
void for_each_shape(F f) {
  std::apply([&](const auto&... shape) { (f(shape), ...); }, numbered_shapes());
}

}  // namespace twinarm
