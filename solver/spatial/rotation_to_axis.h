// The shortest turn that takes z to a direction. Eigen's FromTwoVectors does it by a singular value
// decomposition, 7 s of every compiler run that names it.
#pragma once

#include "solver/spatial/pose.h"

namespace twinarm {

// R_AB with the axis (in A, of any length but 0) as its third column; exactly the identity for an
// axis along +z, half a turn about x for one along -z.
Matrix3 turn_z_to(const Vector3& axis_A);

}  // namespace twinarm
