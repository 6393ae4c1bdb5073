#include "app/lab/stream/mesh_store.h"

#include <algorithm>
#include <utility>

#include "app/lab/stream/mesh_bytes.h"
#include "app/page/draw_columns.h"

namespace twinarm {

std::string MeshStore::keep(Files& files, std::string bytes) {
  std::string name = content_name(bytes);
  files.try_emplace(name, std::make_shared<const std::string>(std::move(bytes)));
  return name;
}

bool MeshStore::take(const DrawList& list) {
  const std::size_t before = mesh_names_.size() + texture_names_.size();
  while (mesh_names_.size() < list.meshes.size())
    mesh_names_.push_back(keep(meshes_, mesh_bytes(*list.meshes[mesh_names_.size()])));
  while (texture_names_.size() < std::min(list.textures.size(), kMostTextures))
    texture_names_.push_back(keep(textures_, texture_file(*list.textures[texture_names_.size()])));
  return mesh_names_.size() + texture_names_.size() > before;
}

std::shared_ptr<const std::string> MeshStore::mesh(const std::string& name) const {
  const auto found = meshes_.find(name);
  return found == meshes_.end() ? nullptr : found->second;
}

std::shared_ptr<const std::string> MeshStore::texture(const std::string& name) const {
  const auto found = textures_.find(name);
  return found == textures_.end() ? nullptr : found->second;
}

}  // namespace twinarm
