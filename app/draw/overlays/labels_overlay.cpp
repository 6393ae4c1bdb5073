// Names of bodies and links.
#include "app/draw/overlays/overlays.h"

namespace twinarm {
namespace {

void show_labels(SceneView& stage, const Snapshot& moment) {
  for (std::size_t i = 1; i < stage.model->parent.size(); ++i)
    add_label(stage.list, com_of(*stage.model, moment.k, i), stage.model->body_name[i], {26, -22},
              14);
}

}  // namespace

Overlays labels_overlay() {
  return {{.place = 140, .name = "labels", .what = "names of bodies", .add = show_labels}};
}

}  // namespace twinarm
