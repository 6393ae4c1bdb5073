// Mass, centre of mass and inertia of solids. Those of shapes: collision/shapes/shape.h.
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

// Of the solid of constant `density` [kg/m^3]. A cavity is a closed part of the mesh that is turned
// inside out. Throws InputError if the mesh is not closed or encloses no positive volume.
MassProperties mass_properties(const TriangleMesh& mesh, double density);

// About its centre, with the principal moments xx, yy, zz.
inline MassProperties centred_solid(double mass, double xx, double yy, double zz) {
  return {mass, Vector3::Zero(), Matrix3(Vector3(xx, yy, zz).asDiagonal())};
}

// The same solid with this mass [kg] instead.
MassProperties with_mass(MassProperties properties, double mass);

// Throws InputError unless the density is positive.
void check_density(double density);

// Of several parts, all given in one frame. A part may have a negative mass (a hole); the sum may
// not: then it throws InputError.
MassProperties combine(std::span<const MassProperties> parts);

}  // namespace twinarm
