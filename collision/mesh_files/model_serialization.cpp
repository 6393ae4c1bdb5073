#include "collision/mesh_files/model_file.h"

#include <stdexcept>

#include "solver/support/state_archive.h"

namespace twinarm {
namespace {

void visit_model(StateArchive& memory, ModelFile& model) {
  memory.resize(model.parts, 1);
  for (ModelPart& part : model.parts)
    memory.visit(part.positions, part.uv, part.triangles, part.has_color, part.color, part.texture);
  memory.resize(model.textures, 1);
  for (ModelTexture& texture : model.textures) memory.visit(texture.name, texture.bytes);
  memory.visit(model.notes);
}

}  // namespace

std::string pack(ModelFile model) {
  StateArchive memory;
  visit_model(memory, model);
  return memory.bytes();
}

std::optional<ModelFile> unpack_model(std::string bytes) {
  StateArchive memory(std::move(bytes));
  ModelFile model;
  try {
    visit_model(memory, model);
  } catch (const std::runtime_error&) {  // truncated
    return std::nullopt;
  }
  return memory.at_end() ? std::optional(std::move(model)) : std::nullopt;
}

}  // namespace twinarm
