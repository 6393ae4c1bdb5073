// From a RobotDescription to the solver's Model.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "collision/import/robot/robot_description.h"
#include "solver/dynamics/model_builder.h"
#include "solver/model/model.h"

namespace twinarm {

// A particle fixed to a link: an added mass (Figure 5 of the paper), a payload.
struct PointMass {
  std::string link;
  Vector3 p_L = Vector3::Zero();  // link axes, from the link's origin [m]
  double mass = 0;                // [kg]
};

struct ModelOptions {
  std::map<std::string, double> mass_scale;  // by link; scales mass and inertia
  std::vector<PointMass> added_masses;
  bool floating = false;   // floating base: free joint at the root link, instead of a fixed one
  bool driven = false;     // prescribed joint there
  bool armature = true;    // false: ignore armatures
  bool friction = true;    // false: ignore damping and Coulomb friction
  bool kinematic = false;  // true: joints that move no inertia are no error; no dynamics
};

// Name of the root link's joint: "base" (floating) or "<root>_on_world" (fixed), with "_" appended
// until it is unique.
std::string root_joint_name(const RobotDescription& robot, bool floating);

// The robot must have passed check_robot. Throws InputError, with lines, for a joint that moves no
// mass or inertia, unless the model is kinematic.
Model<double> build_model(const RobotDescription& robot, const ModelOptions& options = {});

// Adds a robot to a model: `prefix` precedes the names of its links and joints; its root link is
// fixed at X_WR, or floating. Errors of ModelBuilder::build() have no lines.
void add_robot(ModelBuilder& builder, const RobotDescription& robot, const ModelOptions& options,
               const std::string& prefix, const Pose& X_WR);

// Throws InputError if the file was not found.
const std::filesystem::path& file_of(const MeshGeometry& geometry);
// In metres. The triangles of a mirrored mesh are flipped to keep the outward orientation. Throws
// InputError if the file is missing or not a mesh.
TriangleMesh load_mesh(const MeshGeometry& geometry);
// Of a convex mesh its hull. Throws InputError for a mesh that cannot be read or has no volume.
Shape collision_shape(const ShapeDescription& shape);

}  // namespace twinarm
