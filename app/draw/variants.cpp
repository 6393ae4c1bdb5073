// Runs side by side: the same cast once for each, in one colour each, with its name above it.
#include "app/draw/variants.h"

#include "app/draw/palette.h"

namespace twinarm {

// What stands fixed beside the robots looks alike in all.
Color lane_color(const CastPart& part, std::size_t lane) {
  if (part.body == 0 && part.robot < 0) return part.color;
  Color color = palette::lane(lane);
  color.a = part.color.a;
  return color;
}

void draw_lanes(Stage& stage, const Moment& moment) {
  DrawList& list = stage.list;
  for (std::size_t i = 0; i < moment.lanes.size(); ++i) {
    const ShownLane& lane = moment.lanes[i];
    add_label(list, lane.above_W, lane.name, {6, -14});
    list.legend.push_back({palette::lane(i), lane.name});
    if (i == 0) continue;  // has been drawn: it is the run itself
    for (const CastPart& part : stage.cast.parts) {
      Pose X_WM = lane.X_WL[part.body] * part.X_LM;
      X_WM.p += lane.offset_W;
      add_mesh_instance(list, part.mesh, X_WM, lane_color(part, i), part.scale);
    }
    for (const CastTie& tie : stage.cast.ties)
      add_rod(list, lane.offset_W + lane.X_WL[tie.a] * tie.p_La,
              lane.offset_W + lane.X_WL[tie.b] * tie.p_Lb, 0.004 * stage.extent.radius(),
              palette::kConstraint);
  }
}

}  // namespace twinarm
