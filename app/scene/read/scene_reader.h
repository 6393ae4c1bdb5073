// The parts of read_scene. Only app/scene/read_*.cpp include it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/data/table_reader.h"
#include "app/scene/read/scene_description.h"
#include "collision/import/robot/file_search.h"

namespace twinarm {

struct SceneReader {
  std::filesystem::path path;
  std::string file;  // the same, for faults
  FileRoots roots;   // of the files that it names
  FaultList faults;
  SceneDescription scene;

  void read(const TomlValue& root);

  void read_robot(const TomlValue& table);
  void read_body(const TomlValue& table);
  void read_pair(const TomlValue& table);
  void read_coupling(const TomlValue& table, std::size_t index);
  void read_constraint(const TomlValue& table, std::size_t index);

  SceneTable open(const TomlValue& table, std::string where) {
    return SceneTable(table, std::move(where), file, faults);
  }
  // Required, without a stroke, taken by nobody else; the table's faults bear it from then on.
  std::string read_name(SceneTable& table, const char* kind);
  // Of a coupling or constraint: KINDn where it is left out; taken by no other of them.
  template <class Items>
  static std::string read_item_name(SceneTable& table, const char* kind, std::size_t index,
                                    const Items& others) {
    const std::string name = table.text("name").value_or(kind + std::to_string(index));
    table.rename(std::string(kind) + " '" + name + "'");
    for (const auto& other : others)
      if (other.name == name)
        table.fault("name", "the name is taken already",
                    std::string("give each ") + kind + " its own name", "scene.name-taken");
    return name;
  }
  Surface read_surface(SceneTable& table);
  Pose read_pose(SceneTable& table);
  JointValueMap read_joints(SceneTable& table, const char* key, const RobotDescription& robot,
                            bool velocities);
  void lock_joints(SceneTable& table, RobotInScene& robot);
  std::optional<ShapeDescription> read_shape(SceneTable& body);
  // Absolute, relative to the scene, or below assets/; a fault where it is nowhere.
  std::optional<std::filesystem::path> find_file(SceneTable& table, const std::string& key,
                                                 const std::string& name);
};

}  // namespace twinarm
