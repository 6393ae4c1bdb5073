// The reader of models by assimp, a library that the program opens when it needs it
// (app/command/main/modules.cpp).
#pragma once

#include <cstdint>

#include "collision/mesh_files/model_file.h"

namespace twinarm {

constexpr std::uintmax_t kMaxModelBytes = 64u << 20;

}  // namespace twinarm

// Runs in a child process, on the name of a file. Returns ' ' and the packed ModelFile, or '!' and
// an error message.
extern "C" [[gnu::visibility("default")]] twinarm::ChildWork twinarm_assimp_reader();
