// Makes a robot from CAD: part meshes, materials and joints of a recipe
// (app/recipe/README.md).
//
// Mass, centre of mass and inertia of each link are integrals over its part meshes with the
// densities of their materials. Each collision entry is the convex hull of the listed parts.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "collision/geometry/mesh.h"
#include "collision/import/robot/robot_description.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// A recipe (robot.toml) as plain data.

struct RecipeMaterial {
  double density = 0;  // [kg/m^3]
  Vector4 color{0.7, 0.7, 0.7, 1.0};
};

struct RecipePart {
  std::string mesh;  // meshes/<mesh>.stl
  std::string material;
  int line = 0;
};

struct RecipeCollision {
  std::string name;  // file name; default: the link's name, numbered if there are several
  std::vector<std::string> parts;
  int line = 0;
};

struct RecipeLink {
  std::string name;
  int line = 0;
  std::vector<RecipePart> parts;
  std::vector<RecipeCollision> collisions;
};

struct RecipeFile {
  std::string name;
  std::filesystem::path file;  // absolute
  double mesh_scale = 1;       // metres per unit of the meshes
  std::map<std::string, RecipeMaterial> materials;
  std::vector<RecipeLink> links;
  std::vector<JointDescription> joints;
};

// Adds errors to `faults` and continues with default values. Throws InputError at once if the file
// cannot be read or is not TOML.
RecipeFile read_recipe_file(const std::filesystem::path& path, DiagnosticList& faults);

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
RecipeResult make_robot(const std::filesystem::path& recipe_toml);

// A binary STL file with `scale` metres as its unit: 80 bytes of header, number of triangles, 50
// bytes per triangle.
std::string stl_bytes(const TriangleMesh& mesh, double scale);

}  // namespace twinarm
