// Names of bodies and links.
#include "app/draw/overlays/overlays.h"

namespace twinarm {

void show_labels(Stage& stage, const Moment& moment) {
  for (std::size_t i = 1; i < stage.model->parent.size(); ++i)
    add_label(stage.list, com_of(*stage.model, moment.k, i), stage.model->body_name[i], {26, -22},
              14);
}

}  // namespace twinarm
