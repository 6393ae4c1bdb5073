// The message `scene` (docs/reference/lab_protocol.md): names for the numbers in frames.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/draw/scene_view.h"
#include "app/lab/session/scene_builder_thread.h"
#include "app/lab/stream/lab_snapshot.h"
#include "app/render/list/draw_list.h"

namespace twinarm {

// Meshes and textures of a draw list as files, named by the hash of their content.
class MeshStore {
 public:
  // Adds those that are new in the list. True: there were some.
  bool take(const DrawList& list);
  // Names by number in the list.
  const std::vector<std::string>& meshes() const { return mesh_names_; }
  const std::vector<std::string>& textures() const { return texture_names_; }
  // By name, as GET /mesh/HASH and /texture/HASH answer; null: unknown.
  std::shared_ptr<const std::string> mesh(const std::string& name) const;
  std::shared_ptr<const std::string> texture(const std::string& name) const;

 private:
  using Files = std::map<std::string, std::shared_ptr<const std::string>>;

  std::vector<std::string> mesh_names_, texture_names_;
  Files meshes_, textures_;
};

// Of all layers, in the order of their numbers in frames.
const std::vector<std::string>& layer_names();

struct SceneFacts {
  std::uint32_t number = 0;
  const SimulatePlan& plan;
  const SceneWords& words;
  const LabSnapshots& snapshots;
  const SceneView& stage;
  const MeshStore& store;
  const std::vector<std::vector<LegendLine>>& legends;  // by layer
  const std::vector<RunColumn>& channels;
  const std::vector<std::string>& rows;
};
std::string scene_message(const SceneFacts& facts);

}  // namespace twinarm
