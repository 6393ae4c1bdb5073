#include "collision/mesh_files/model_file.h"

#include <stdexcept>

#include "solver/support/state_archive.h"

namespace twinarm {
namespace {

template <class Rows>
void visit_rows(StateArchive& memory, Rows& rows) {
  memory.resize(rows, sizeof(rows[0]));
  for (auto& row : rows)
    for (auto& number : row) memory.visit(number);
}

void visit_model(StateArchive& memory, ModelFile& model) {
  memory.resize(model.parts, 1);
  for (ModelPart& part : model.parts) {
    visit_rows(memory, part.positions);
    visit_rows(memory, part.uv);
    visit_rows(memory, part.triangles);
    memory.visit(part.has_color);
    for (float& number : part.color) memory.visit(number);
    memory.visit(part.texture);
  }
  memory.resize(model.textures, 1);
  for (ModelTexture& texture : model.textures) memory.visit(texture.name, texture.bytes);
  memory.resize(model.notes, 1);
  for (std::string& note : model.notes) memory.visit(note);
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
