// What comes home from the child process that reads a mesh, which may have been broken.
#include "collision/mesh_files/model_file.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {

void packed_model(Bytes bytes) {
  if (const auto model = unpacked<ModelFile>(std::string(bytes)))
    require(packed(*model) == bytes, "a packed model is not what was unpacked");
}

}  // namespace twinarm::fuzz
