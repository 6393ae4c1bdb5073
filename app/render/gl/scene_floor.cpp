// What is behind the bodies: the floor, and the background where there is none. See scene_pass.h.
//
// The floor is drawn once, in pieces: without looking up shadows where none can be
// (shadow_tiles.h). The pieces are cut by the scissor and not by geometry, so that each pixel is
// what it would be in the whole.
#include <Eigen/LU>

#include "app/render/gl/scene_pass.h"

namespace twinarm {

void ScenePass::set_floor(const Program& program, const LightSample& sample) const {
  const Ground& ground = list_->ground;
  const Vector3& center = list_->camera.target;
  set_frame(program, sample);
  set_backdrop(program);
  const auto set = [&](Uniform uniform, const Eigen::Vector4d& value) {
    program.set(uniform, Eigen::Vector4f(value.cast<float>()));
  };
  const double strong = ground.cell * ground.cells_per_major, fade = has_horizon() ? 0.5 : 1.0;
  set(Uniform::ground, {center.x(), center.y(), ground.height, floor_radius_});
  set(Uniform::grid, {ground.cell, strong, 0.008 * ground.cell, 0});
  set(Uniform::per_grid, {1 / ground.cell, 1 / strong, 1 / floor_radius_, 1 / fade});
}

// Where a shadow can be: two texels and a half about the place that is looked up, which the normal
// offset has moved.
std::vector<FloorTiles> ScenePass::shadow_tiles(const LightSample& sample) const {
  const double texel = 2.02 * bounds_.solid.radius / used_side(key_map_);
  return floor_tiles(casters_, {sample.key_W, list_->ground.height, 2.5 * texel + normal_offset()},
                     shifted_clip(sample), width_, height_);
}

void ScenePass::draw_floor(const LightSample& sample) const {
  const std::vector<FloorTiles> tiles = shadow_tiles(sample);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.BindVertexArray(no_vertices_);
  for (const bool shadowed : {false, true}) {
    set_floor(shadowed ? backdrop().floor : backdrop().lit_floor, sample);
    for (const FloorTiles& part : tiles) {
      if (part.maybe_shadowed != shadowed) continue;
      gl_.Scissor(part.x, part.y, part.width, part.height);
      gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
  }
  gl_.Disable(GL_SCISSOR_TEST);
}

// Where the floor fills whole rows of the picture, from below, nothing would come of it but work.
void ScenePass::draw_background(const LightSample& sample) const {
  const int rows =
      list_->ground.visible
          ? rows_all_floor(clip_from_world_,
                           {list_->camera.target, list_->ground.height, floor_radius_}, height_)
          : 0;
  if (rows >= height_) return;
  const Program& background = backdrop().background;
  background.use();
  set_backdrop(background);
  background.set(Uniform::eye, Eigen::Vector3f(list_->camera.eye.cast<float>()));
  background.set(Uniform::world_from_clip,
                 Eigen::Matrix4f(shifted_clip(sample).inverse().cast<float>()));
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Scissor(0, rows, width_, height_ - rows);
  gl_.DepthMask(GL_FALSE);
  gl_.BindVertexArray(no_vertices_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.DepthMask(GL_TRUE);
  gl_.Disable(GL_SCISSOR_TEST);
}

}  // namespace twinarm
