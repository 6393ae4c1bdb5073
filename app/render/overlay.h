// Overlay: title, legend and labels onto a finished picture.
#pragma once

#include <Eigen/Core>

#include "app/render/draw_list.h"
#include "app/render/image.h"
#include "app/render/lettering.h"

namespace twinarm {

// `clip_from_world` is the projection with which the picture was made.
void draw_overlay(Image& image, const DrawList& list, const Eigen::Matrix4d& clip_from_world,
                  Lettering& lettering);

}  // namespace twinarm
