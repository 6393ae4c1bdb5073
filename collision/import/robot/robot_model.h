// From a robot's description to the solver's model.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "collision/import/robot/robot_description.h"
#include "solver/dynamics/model_builder.h"
#include "solver/model/model.h"

namespace twinarm {

// A particle fixed to a link: the paper's added masses (its Figure 5), a payload.
struct PointMass {
  std::string link;
  Vector3 p_L = Vector3::Zero();  // link axes, from the link's origin [m]
  double mass = 0;                // [kg]
};

struct ModelOptions {
  std::map<std::string, double> mass_scale;  // by link; scales mass and inertia
  std::vector<PointMass> added_masses;
  bool floating =
      false;  // the root link is carried by a free joint, and does not stand on the world
  bool armature = true;  // false: as if no joint had any
  bool friction = true;  // false: as if no joint had damping or Coulomb friction
};

// The root link is always the first body after the world (of a robot alone in its model).
inline constexpr int kRootBody = 1;

// The joint that carries the root link: "base" where it floats, "<root>_on_world" where it stands,
// with as many "_" after it as make it no joint of the robot.
std::string root_joint_name(const RobotDescription& robot, bool floating);

// The robot must have passed check_robot. Throws InputError, with the lines of the description, for
// what the solver cannot carry: a joint that moves nothing of mass or inertia.
Model<double> build_model(const RobotDescription& robot, const ModelOptions& options = {});

// One robot among others in a model: `prefix` comes before the names of its links and joints, and
// its root link stands at X_WR (or is placed by the state, where it floats). The builder knows no
// lines: what build() finds later comes without.
void add_robot(ModelBuilder& builder, const RobotDescription& robot, const ModelOptions& options,
               const std::string& prefix, const Pose& X_WR);

// The triangles of a MeshGeometry.

// Where its file lies. Throws InputError where it was not found.
const std::filesystem::path& file_of(const MeshGeometry& geometry);
// In metres. A mirrored mesh (an odd number of negative scales) has its triangles turned about, so
// that they are still counter-clockwise seen from outside. Throws InputError where the file is
// missing or no mesh.
TriangleMesh load_mesh(const MeshGeometry& geometry);

}  // namespace twinarm
