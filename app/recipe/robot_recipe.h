// Makes a robot from CAD: part meshes, materials and joints of a recipe
// (app/recipe/README.md).
//
// Mass, centre of mass and inertia of each link are integrals over its part meshes with the
// densities of their materials. Each collision entry is the convex hull of the listed parts.
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

// Writes no files. Throws InputError with all errors of the recipe, each with its line.
RecipeResult read_recipe(const std::filesystem::path& recipe_toml);

// Writes <name>.urdf and collision/*.stl next to the recipe; deterministic.
void make_robot(const std::filesystem::path& recipe_toml);

// A binary STL file with `scale` metres as its unit: 80 bytes of header, number of triangles, 50
// bytes per triangle.
std::string stl_bytes(const TriangleMesh& mesh, double scale);

}  // namespace twinarm
