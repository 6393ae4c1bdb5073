// The message `scene` (docs/lab_protocol.md): what the numbers in frames mean.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/draw/scene_view.h"
#include "app/lab/stream/lab_channels.h"
#include "app/lab/stream/lab_snapshot.h"
#include "app/lab/stream/lab_view.h"
#include "app/lab/stream/mesh_store.h"

namespace twinarm {

// Of all layers, in the order of their numbers in frames.
const std::vector<std::string>& layer_names();

struct SceneFacts {
  std::uint32_t number = 0;
  const SimulatePlan& plan;
  const SceneWords& words;
  const LabMoments& moments;
  const Stage& stage;
  const MeshStore& store;
  const std::vector<std::vector<LegendLine>>& legends;  // by layer
  const std::vector<RunColumn>& channels;
  const std::vector<std::string>& rows;
};
std::string scene_message(const SceneFacts& facts);

}  // namespace twinarm
