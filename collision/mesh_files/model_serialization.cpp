#include "collision/mesh_files/model_file.h"

namespace twinarm {

void serialize(StateArchive& memory, ModelFile& model) {
  memory.resize(model.parts, 1);
  for (ModelPart& part : model.parts)
    memory.visit(part.positions, part.uv, part.triangles, part.has_color, part.color, part.texture);
  memory.resize(model.textures, 1);
  for (ModelTexture& texture : model.textures) memory.visit(texture.name, texture.bytes);
  memory.visit(model.notes);
}

}  // namespace twinarm
