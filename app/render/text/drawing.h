// Flat shapes onto an Image: pixels from the top left, y down; edges are smooth by their cover.
#pragma once

#include <Eigen/Core>

#include "app/render/list/draw_list.h"
#include "app/render/list/image.h"

namespace twinarm {

// With corners of the given radius.
void draw_box(Image& image, const Eigen::Vector2d& low, const Eigen::Vector2d& high, double radius,
              const Color& color);
// With round ends.
void draw_line(Image& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width,
               const Color& color);
void draw_dot(Image& image, const Eigen::Vector2d& center, double radius, const Color& color);

}  // namespace twinarm
