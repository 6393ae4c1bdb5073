// Makes a robot from the recipe of one drawn in CAD: part meshes, materials, joints.
//
// The mass, centre of mass and inertia of each link are integrals over its parts' meshes with the
// density of their materials; nothing is typed in. Each collision entry is the convex hull of the
// parts that it lists. The shape of the file is told in collision/import/README.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "collision/geometry/mesh.h"
#include "collision/import/robot/robot_description.h"

namespace twinarm {

struct HullFile {
  std::filesystem::path file;  // absolute: collision/<name>.stl beside the recipe
  double scale = 1;            // metres per unit of the file
  TriangleMesh hull;           // in metres
};

struct RecipeResult {
  RobotDescription robot;  // `file` is that of the recipe
  std::vector<HullFile> hulls;
};

// Computes; writes nothing. Throws InputError with all faults of the recipe, each with its line.
RecipeResult read_recipe(const std::filesystem::path& recipe_toml);

// Writes <name>.urdf and collision/*.stl next to the recipe. The same recipe and meshes give the
// same bytes.
void make_robot(const std::filesystem::path& recipe_toml);

// Binary STL: 80 bytes of header, the number of triangles, and 50 bytes a triangle.

// The bytes of the file. Its unit is `scale` metres; coordinates are single precision, as the
// format has it. The same mesh gives the same bytes.
std::string stl_bytes(const TriangleMesh& mesh, double scale);

}  // namespace twinarm
