// A recipe (robot.toml) as plain data.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "collision/import/robot/robot_description.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

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

}  // namespace twinarm
