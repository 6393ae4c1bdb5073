// Runs side by side (Moment::lanes): the first is drawn as a run alone is, but in its lane's
// colour.
#pragma once

#include "app/draw/scene_view.h"

namespace twinarm {

Color lane_color(const CastPart& part, std::size_t lane);
// The others, and the names of all.
void draw_lanes(Stage& stage, const Moment& moment);

}  // namespace twinarm
