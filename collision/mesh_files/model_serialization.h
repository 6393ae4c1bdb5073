// A ModelFile as bytes, to be sent from the process that read it.
#pragma once

#include <optional>
#include <string>

#include "collision/mesh_files/model_file.h"

namespace twinarm {

std::string pack(ModelFile model);
// Empty where the bytes are no such model: whoever sent them may have been broken. Indices are not
// looked at.
std::optional<ModelFile> unpack_model(std::string bytes);

}  // namespace twinarm
