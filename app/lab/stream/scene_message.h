// Names for the numbers in frames, for the message `scene` (docs/reference/lab_protocol.md).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

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

}  // namespace twinarm
