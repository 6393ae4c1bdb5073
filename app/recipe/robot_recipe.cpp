// Recipe -> meshes -> mass properties and hulls -> robot.

#include "app/recipe/robot_recipe.h"

#include <bit>
#include <set>

#include "app/support/parallel_for.h"
#include "app/support/progress.h"
#include "collision/import/robot/robot_check.h"
#include "collision/import/urdf/urdf.h"
#include "collision/mesh_files/mesh_file.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

class RobotFromCad {
 public:
  explicit RobotFromCad(const std::filesystem::path& file)
      : recipe_(read_recipe_file(file, faults_)) {}

  RecipeResult run() {
    result_.robot.name = recipe_.name;
    result_.robot.file = recipe_.file;
    result_.robot.joints = recipe_.joints;
    file_name(recipe_.name, "recipe", 1);
    Progress progress(false, Progress::kPatience);
    for (const RecipeLink& link : recipe_.links) {
      progress.stage("link " + link.name, 0.3 / static_cast<double>(recipe_.links.size()));
      check_interrupt();
      make_link(link);
    }
    progress.stage("convex hulls", 0.7);
    make_hulls(progress);
    RobotCheck check = check_robot(result_.robot, true);
    faults_.add(check.faults);
    result_.robot.warnings = std::move(check.warnings);
    throw_in_line_order(faults_.faults());
    result_.robot.root = find_root(result_.robot);
    return std::move(result_);
  }

 private:
  void fault(int line, std::string where, std::string problem, std::string fix) {
    faults_.add({recipe_.file.string(), line, std::move(where), std::move(problem), std::move(fix),
                 "recipe.robot"});
  }

  // Calls f and reports its errors with a line of the recipe.
  template <class F>
  auto with_line(int line, const std::string& where, F f) -> std::optional<decltype(f())> {
    try {
      return f();
    } catch (const InputError& error) {
      for (const Diagnostic& inner : error.faults())
        fault(line, where, (inner.file.empty() ? "" : inner.file + ": ") + inner.problem,
              inner.fix);
      return std::nullopt;
    }
  }

  void file_name(const std::string& name, const std::string& where, int line) {
    if (name.find_first_of("/\\:") != std::string::npos)
      fault(line, where, "'" + name + "' is used as a file name and has a '/', '\\' or ':'",
            "use letters, digits and _");
  }

  std::filesystem::path mesh_file(const RecipePart& part) const {
    return recipe_.file.parent_path() / "meshes" / (part.mesh + ".stl");
  }

  void make_link(const RecipeLink& recipe) {
    LinkDescription link;
    link.name = recipe.name;
    link.line = recipe.line;
    std::map<std::string, TriangleMesh> meshes;  // by the name of the part
    std::vector<MassProperties> masses;
    for (const RecipePart& part : recipe.parts) make_part(part, link, meshes, masses);
    if (!masses.empty()) {
      const std::string where = "link '" + link.name + "'";
      if (const auto sum = with_line(link.line, where, [&] { return combine(masses); })) {
        link.has_inertia = true;
        link.mass = sum->mass;
        link.com = sum->com;
        link.inertia = 0.5 * (sum->inertia + sum->inertia.transpose());
      }
    }
    for (const RecipeCollision& collision : recipe.collisions) add_hull(collision, meshes, link);
    result_.robot.links.push_back(std::move(link));
  }

  void make_part(const RecipePart& part, LinkDescription& link,
                 std::map<std::string, TriangleMesh>& meshes, std::vector<MassProperties>& masses) {
    const std::string where = "link '" + link.name + "', part '" + part.mesh + "'";
    const auto material = recipe_.materials.find(part.material);
    if (material == recipe_.materials.end() && !part.material.empty())
      fault(part.line, where, "material '" + part.material + "' does not exist",
            "give [material." + part.material + "] with density and color");
    if (meshes.count(part.mesh)) {
      fault(part.line, where, "the part is listed twice", "list each part of a link once");
      return;
    }
    if (part.mesh.empty()) return;
    const auto mesh =
        with_line(part.line, where, [&] { return load_mesh(mesh_file(part), recipe_.mesh_scale); });
    // Also a part that cannot be read is entered: no second error for its hull.
    meshes[part.mesh] = mesh.value_or(TriangleMesh());
    if (!mesh || material == recipe_.materials.end()) return;
    VisualPart visual;
    visual.name = part.mesh;
    visual.line = part.line;
    visual.geometry = MeshGeometry{mesh_file(part), Vector3::Constant(recipe_.mesh_scale), {}};
    visual.material = part.material;
    visual.color = material->second.color;
    link.visuals.push_back(std::move(visual));
    if (const auto mass = with_line(
            part.line, where, [&] { return mass_properties(*mesh, material->second.density); }))
      masses.push_back(*mass);
  }

  void add_hull(const RecipeCollision& collision, const std::map<std::string, TriangleMesh>& meshes,
                LinkDescription& link) {
    const std::string where = "link '" + link.name + "', collision '" + collision.name + "'";
    file_name(collision.name, where, collision.line);
    if (!hull_names_.insert(collision.name).second)
      fault(collision.line, where, "duplicate name of a collision", "give each its own `name`");
    HullPoints hull{where,
                    collision.line,
                    recipe_.file.parent_path() / "collision" / (collision.name + ".stl"),
                    {}};
    for (const std::string& part : collision.parts) {
      const auto mesh = meshes.find(part);
      if (mesh == meshes.end()) {
        fault(collision.line, where, "part '" + part + "' is not a part of this link",
              "list parts of this link");
        return;
      }
      if (mesh->second.vertices.empty()) return;  // reported already
      hull.points.insert(hull.points.end(), mesh->second.vertices.begin(),
                         mesh->second.vertices.end());
    }
    CollisionPart part;
    part.name = collision.name;
    part.line = collision.line;
    part.geometry = MeshGeometry{hull.file, Vector3::Constant(recipe_.mesh_scale), {}};
    link.collisions.push_back(std::move(part));
    hulls_.push_back(std::move(hull));
  }

  void make_hulls(Progress& progress) {
    auto hulls = parallel_results(
        hulls_.size(), [&](std::size_t k) { return convex_hull(hulls_[k].points); },
        [&](std::size_t done) { progress.advance(done, hulls_.size()); });
    for (std::size_t k = 0; k < hulls.size(); ++k)
      if (auto hull = with_line(hulls_[k].line, hulls_[k].where, [&] { return hulls[k].get(); }))
        result_.hulls.push_back({std::move(hulls_[k].file),
                                 recipe_.mesh_scale,
                                 {std::move(hull->vertices), std::move(hull->triangles)}});
  }

  struct HullPoints {
    std::string where;  // in error messages
    int line;
    std::filesystem::path file;
    std::vector<Vector3> points;
  };

  DiagnosticList faults_;  // before recipe_, whose initialisation fills it
  RecipeFile recipe_;
  RecipeResult result_;
  std::set<std::string> hull_names_;
  std::vector<HullPoints> hulls_;
};

std::string comment_for(const RobotDescription& robot) {
  double mass = 0;
  for (const LinkDescription& link : robot.links) mass += link.mass;
  return "Made from " + robot.file.filename().string() +
         " and the meshes; do not edit, change the recipe and make it again.\n"
         "Masses and inertias are integrals over the meshes with the densities of the recipe; "
         "total " +
         number_text(mass) + " kg.\nSI units, radians; collision meshes are convex hulls.";
}

}  // namespace

RecipeResult read_recipe(const std::filesystem::path& recipe_toml) {
  return RobotFromCad(recipe_toml).run();
}

RecipeResult make_robot(const std::filesystem::path& recipe_toml) {
  RecipeResult result = read_recipe(recipe_toml);
  const std::filesystem::path folder = result.robot.file.parent_path();
  for (const HullFile& hull : result.hulls) {
    std::error_code ignored;  // writing reports the error
    std::filesystem::create_directories(hull.file.parent_path(), ignored);
    write_whole_file(hull.file, stl_bytes(hull.hull, hull.scale));
  }
  write_urdf(result.robot, folder / (result.robot.name + ".urdf"), comment_for(result.robot));
  return result;
}

static_assert(std::endian::native == std::endian::little, "STL files are little-endian");

std::string stl_bytes(const TriangleMesh& mesh, double scale) {
  std::string bytes = "binary STL, written by twinarm";  // must not start with "solid"
  bytes.resize(80, ' ');
  const auto append = [&bytes](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  append(&count, 4);
  for (const auto& triangle : mesh.triangles) {
    Eigen::Vector3f vertex[3];
    for (int k = 0; k < 3; ++k) vertex[k] = (mesh.vertices[triangle[k]] / scale).cast<float>();
    const Eigen::Vector3f normal =
        (vertex[1] - vertex[0]).cross(vertex[2] - vertex[0]).normalized();
    append(normal.data(), 12);
    for (const Eigen::Vector3f& c : vertex) append(c.data(), 12);
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace twinarm
