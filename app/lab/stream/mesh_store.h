// Meshes and textures of a draw list, by what is in them.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/render/list/draw_list.h"

namespace twinarm {

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

}  // namespace twinarm
