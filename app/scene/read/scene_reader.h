// Implementation of read_scene(); only read_*.cpp include it.
#pragma once

#include <set>

#include "app/scene/read/scene_description.h"
#include "collision/import/robot/file_search.h"

namespace twinarm {

struct SceneReader {
  std::filesystem::path path;
  std::string file;  // path, for diagnostics
  FileRoots roots;   // folders that may contain the files it names
  DiagnosticList faults;
  SceneDescription scene;
  std::set<std::pair<std::string, std::string>> taken_names;  // by kind; robots are bodies

  void read(const Value& root);

  void read_robot(const Value& table);
  void read_body(const Value& table);
  void read_pair(const Value& table);
  void read_coupling(const Value& table, std::size_t index);
  void read_constraint(const Value& table, std::size_t index);
  void read_spring(const Value& table, std::size_t index);

  TableReader open(const Value& table, std::string where) {
    return TableReader(table, std::move(where), file, faults);
  }
  // Required, unique, without a slash; later diagnostics of the table name it.
  std::string read_name(TableReader& table, const char* kind);
  // Name of a coupling, constraint or spring, unique among them; default KINDn.
  std::string read_item_name(TableReader& table, const char* kind, std::size_t index) {
    const std::string name = table.text("name").value_or(kind + std::to_string(index));
    table.rename(std::string(kind) + " '" + name + "'");
    if (!taken_names.emplace(kind, name).second)
      table.fault("name", "the name is already used",
                  std::string("give each ") + kind + " its own name", "scene.name-taken");
    return name;
  }
  std::optional<BodyMotion> read_motion(TableReader& table);
  // Initial velocities; if not is_free, a diagnostic with this problem and fix.
  template <class Item>
  static void read_velocities(TableReader& table, Item& item, bool is_free,
                              const std::pair<const char*, const char*>& fault) {
    for (const auto& [key, velocity] : {std::pair{"linear_velocity", &item.linear_velocity},
                                        std::pair{"angular_velocity", &item.angular_velocity}}) {
      *velocity = table.vector(key).value_or(Vector3::Zero());
      if (!is_free && !velocity->isZero(0))
        table.fault(key, fault.first, fault.second, "scene.key-useless");
    }
  }
  ContactSurface read_surface(TableReader& table);
  Pose read_pose(TableReader& table);
  JointValueMap read_joints(TableReader& table, const char* key, const RobotDescription& robot,
                            JointRows rows);
  void lock_joints(TableReader& table, RobotInScene& robot);
  std::optional<ShapeDescription> read_shape(TableReader& body);
  // Absolute, relative to the scene, or in assets/; a diagnostic if it does not exist.
  std::optional<std::filesystem::path> find_file(TableReader& table, const std::string& key,
                                                 const std::string& name);
};

}  // namespace twinarm
