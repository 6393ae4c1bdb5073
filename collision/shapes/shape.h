// Shapes, each in its own geometry frame G (its pose is X_WG), and what is asked of all of them.
//
// Adding one that is stated by a few numbers: a file such as cylinder.h, included here. It says
// which number it has (shape_number.h), and must have
//   name, key            in messages, and in files: "hollow sphere", "hollow_sphere"
//   lengths()            what files state of it: doubles and Vector3, all > 0
//   support(d)           its point that lies farthest along d (any length but zero):
//                        h(d) = max over x of d . x is attained there
// and either polytope(), a polyhedron with a radius, or patches(), its surface in smooth pieces. It
// may have
//   solid(density)       mass properties; without it, it encloses nothing
//   is_in_urdf           URDF has it, as <key length_1 ..>
//   nearest(p)           closed form of its distance from a point: exact contacts with spheres
//   max_points(d)   the points that may lie on a plane, where it is curved
// Then robots and scenes read and write it, it is drawn as its hull, and it is collided with all
// convex shapes, half-spaces and meshes; a polyhedron also within hollow shapes.
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
#include "collision/shapes/cylinder.h"
#include "collision/shapes/ellipsoid.h"
#include "collision/shapes/half_space.h"
#include "collision/shapes/hollow_cylinder.h"
#include "collision/shapes/hollow_sphere.h"
#include "collision/shapes/mesh_shape.h"
#include "collision/shapes/sphere.h"

namespace twinarm {

// Each ShapeNumber from this one on, as it is by default.
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

// Those that are stated by a few numbers, and others.
template <class... Others>
using AnyShape = decltype(one_of(numbered_shapes(), std::declval<Others>()...));
using Shape = AnyShape<ConvexHull, MeshShape>;

// Of a hollow shape, that of the solid that would fill it.
Vector3 support(const Shape& shape, const Vector3& direction);

// What is wrong with the numbers of a shape, empty if nothing: "radius is -1 m, must be positive".
std::string shape_fault(const Shape& shape);

// "box", "convex hull", ...
std::string shape_name(const Shape& shape);

// `exists` is false for curved shapes and half-spaces.
Polytope make_polytope(const Shape& shape);

// Of any convex bounded shape, in its frame; empty for the others.
Patches make_patches(const Shape& shape, const Polytope& core);

// Of a shape filled with constant `density` [kg/m^3]. Throws InputError for a bad shape, and for
// one that encloses no solid: half-spaces, hollows.
MassProperties mass_properties(const Shape& shape, double density);

// Calls f(name, value) for each double or Vector3 that a file states of a shape. [m]
template <class S, class F>
void for_each_length(S& shape, F f) {
  std::apply([&](const auto&... of) { (f(of.first, shape.*of.second), ...); },
             std::remove_const_t<S>::lengths());
}

// Calls f(shape) for each numbered one as it is by default, in their order.
template <class F>
void for_each_shape(F f) {
  std::apply([&](const auto&... shape) { (f(shape), ...); }, numbered_shapes());
}

}  // namespace twinarm
