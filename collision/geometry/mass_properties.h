// Mass, centre of mass and inertia of solids (of shapes: collision/shapes/shape.h).
#pragma once

#include <span>

#include "collision/geometry/mesh.h"
#include "solver/spatial/pose.h"

namespace twinarm {

struct MassProperties {
  double mass = 0;                    // [kg]
  Vector3 com = Vector3::Zero();      // centre of mass, in the frame of the mesh [m]
  Matrix3 inertia = Matrix3::Zero();  // about com, along the axes of that frame [kg m^2]
};

// Of a solid of constant `density` [kg/m^3]. A cavity is a closed part of the mesh with inward
// orientation. Throws InputError if the mesh is not closed or its volume is not positive.
MassProperties mass_properties(const TriangleMesh& mesh, double density);

// With the centre of mass at the origin and principal moments xx, yy, zz.
inline MassProperties centred_solid(double mass, double xx, double yy, double zz) {
  return {mass, Vector3::Zero(), Matrix3(Vector3(xx, yy, zz).asDiagonal())};
}

// Scaled to a given mass [kg].
MassProperties with_mass(MassProperties properties, double mass);

// Throws InputError unless the density is positive.
void check_density(double density);

// Sum of parts in one frame. A part may have negative mass (a hole); throws InputError if the sum
// is not positive.
MassProperties combine(std::span<const MassProperties> parts);

}  // namespace twinarm
