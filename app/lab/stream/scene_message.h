// The message `scene` (docs/reference/lab_protocol.md): what the numbers in frames mean.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/draw/scene_view.h"
#include "app/lab/stream/lab_snapshot.h"
#include "app/lab/stream/lab_view.h"
#include "app/render/list/draw_list.h"
#include "app/render/list/draw_mesh.h"

namespace twinarm {

// Meshes and textures of a draw list, by what is in them.
class MeshStore {
 public:
  // Those that it has not seen yet, by their numbers in the list. True: there were any.
  bool take(const DrawList& list);
  // By number; those of equal content have one name.
  const std::vector<std::string>& meshes() const { return mesh_names_; }
  const std::vector<std::string>& textures() const { return texture_names_; }
  std::shared_ptr<const std::string> mesh(const std::string& name) const;
  std::shared_ptr<const std::string> texture(const std::string& name) const;

 private:
  using Files = std::map<std::string, std::shared_ptr<const std::string>>;
  static std::string keep(Files& files, std::string bytes);

  std::vector<std::string> mesh_names_, texture_names_;
  Files meshes_, textures_;
};

// Meshes as GET /mesh/HASH sends them, and what they are called.

// u32 vertices, indices, flags (1: two-sided, 2: has uv), 0; then positions, normals, uv, indices.
std::string mesh_bytes(const DrawMesh& mesh);
// 128 bits in hexadecimal: of equal content equal, else different.
std::string content_name(const std::string& bytes);

// Of all layers, in the order of their numbers in frames.
const std::vector<std::string>& layer_names();

struct SceneFacts {
  std::uint32_t number = 0;
  const SimulatePlan& plan;
  const SceneWords& words;
  const LabMoments& moments;
  const SceneView& stage;
  const MeshStore& store;
  const std::vector<std::vector<LegendLine>>& legends;  // by layer
  const std::vector<RunColumn>& channels;
  const std::vector<std::string>& rows;
};
std::string scene_message(const SceneFacts& facts);

}  // namespace twinarm
