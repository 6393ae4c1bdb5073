#include "app/render/gl/scene_pass.h"

#include <algorithm>
#include <cmath>

namespace twinarm {
namespace {

constexpr int kKeyMapSide = 2048, kSkyMapSide = 1024;        // [texels]
constexpr int kKeyUnit = 0, kSkyUnit = 1, kPictureUnit = 2;  // texture units

// IEC 61966-2-1.
float linear(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

Eigen::Vector3f linear(const Color& c) {
  return {linear(c.r), linear(c.g), linear(c.b)};
}

ShaderVariant with(bool ShaderVariant::*part, bool value, ShaderVariant variant) {
  variant.*part = value;
  return variant;
}

// Subpixel offset in clip space.
Eigen::Matrix4d shift(const Eigen::Vector2d& shift_px, int width, int height) {
  Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
  X(0, 3) = 2 * shift_px.x() / width;
  X(1, 3) = 2 * shift_px.y() / height;
  return X;
}

}  // namespace

ScenePass::ScenePass(const GlTable& gl, int width, int height, const ShaderVariant& variant,
                     bool multisampled)
    : gl_(gl),
      width_(width),
      height_(height),
      canvas_(gl, width, height, multisampled),
      key_map_(gl, kKeyMapSide, !variant.soft_shadow),
      variant_(variant),
      solid_(gl, solid_shader(variant)),
      textured_(gl, solid_shader(with(&ShaderVariant::textured, true, variant))),
      translucent_(gl, translucent_shader(variant)),
      depth_(gl, depth_shader()) {
  if (variant.sky_sample) sky_map_.emplace(gl, kSkyMapSide, true);
  gl.GenVertexArrays(1, &no_vertices_);
}

void ScenePass::prepare(const DrawList& list) {
  list_ = &list;
  bounds_ = bound_scene(list);
  floor_radius_ = floor_radius(list, bounds_);
  clip_from_world_ = make_clip_from_world(list.camera, static_cast<double>(width_) / height_,
                                          bounds_, floor_radius_);
  std::optional<Backdrop>& backdrop = backdrops_[has_horizon() ? 1 : 0];
  if (!backdrop) {
    const ShaderVariant variant = with(&ShaderVariant::horizon, has_horizon(), variant_);
    backdrop.emplace(Backdrop{{gl_, floor_shader(variant)},
                              {gl_, floor_shader(with(&ShaderVariant::key_shadow, false, variant))},
                              {gl_, background_shader(variant)}});
  }
  const auto is_unused = [](const auto& entry) { return entry.second.source.use_count() == 1; };
  std::erase_if(cache_, is_unused);
  std::erase_if(textures_, is_unused);
  items_.clear();
  casters_.clear();
  for (const Instance& instance : list.instances) add_item(list, instance);
}

void ScenePass::add_item(const DrawList& list, const Instance& instance) {
  const Vector3& scale = instance.scale;
  Item item;
  const std::shared_ptr<const DrawMesh>& mesh = list.meshes[instance.mesh];
  const CachedMesh& cached = cache_.try_emplace(mesh.get(), gl_, mesh).first->second;
  item.mesh = &cached.gpu;
  item.two_sided = mesh->two_sided;
  item.translucent = instance.color.a < 1;
  item.texture = nullptr;
  if (instance.texture && !mesh->uv.empty() && !item.translucent) {
    const std::shared_ptr<const Image>& image = list.textures[*instance.texture];
    item.texture = &textures_.try_emplace(image.get(), gl_, image).first->second.gpu;
  }
  item.world_from_mesh.setIdentity();
  item.world_from_mesh.topLeftCorner<3, 3>() = (instance.X_WM.R * scale.asDiagonal()).cast<float>();
  item.world_from_mesh.topRightCorner<3, 1>() = instance.X_WM.p.cast<float>();
  // Inverse transpose of R * scale, times the smallest scale.
  const Vector3 inverse = scale.minCoeff() * scale.cwiseInverse();
  item.normal_from_mesh = (instance.X_WM.R * inverse.asDiagonal()).cast<float>();
  item.color << linear(instance.color), instance.color.a;
  item.shininess = instance.shininess;
  item.seen_through = instance.seen_through;
  if (item.world_from_mesh.allFinite() && item.normal_from_mesh.allFinite()) {
    items_.push_back(item);
    if (!item.translucent && !cached.box.isEmpty())
      casters_.push_back(
          {{instance.X_WM.R, instance.X_WM * scale.cwiseProduct(cached.box.center())},
           0.5 * scale.cwiseProduct(cached.box.sizes())});
  }
}

void ScenePass::draw(const LightSample& sample) {
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  draw_shadow(key_map_, sample.key_W);
  if (sky_map_) draw_shadow(*sky_map_, sample.sky_W);
  canvas_.begin();
  draw_solids(sample);
  if (list_->ground.visible) draw_floor(sample);
  draw_background(sample);
  const auto is_blended = [](const Item& item) { return item.translucent || item.seen_through; };
  if (std::ranges::none_of(items_, is_blended)) return;
  gl_.Enable(GL_FRAMEBUFFER_SRGB);
  gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);  // stays opaque
  draw_hidden(sample);
  draw_translucent(sample);
  gl_.Disable(GL_FRAMEBUFFER_SRGB);
}

Eigen::Matrix4f ScenePass::light_clip_from_world(const Vector3& towards_light_W) const {
  return make_light_clip_from_world(towards_light_W, bounds_.solid).cast<float>();
}

// Texels as large as pixels suffice.
int ScenePass::used_side(const ShadowMap& map) const {
  const double texels = shadow_texels(list_->camera, bounds_, height_);
  return static_cast<int>(std::clamp(texels, 256.0, static_cast<double>(map.side_px)));
}

// Distance from the surface at which shadows are looked up: 1.5 texels of the coarser map [m].
double ScenePass::normal_offset() const {
  const int key_side = used_side(key_map_);
  const int side = sky_map_ ? std::min(key_side, used_side(*sky_map_)) : key_side;
  return 3.0 * bounds_.solid.radius / side;
}

// From the world to texture coordinates of the used square and depth in 0..1.
Eigen::Matrix4f ScenePass::shadow_from_world(const ShadowMap& map,
                                             const Vector3& towards_light_W) const {
  const float share = 0.5f * static_cast<float>(used_side(map)) / static_cast<float>(map.side_px);
  Eigen::Matrix4f half = Eigen::Matrix4f::Identity();
  half.diagonal() << share, share, 0.5f, 1;
  half.col(3).head<3>() = half.diagonal().head<3>();
  return half * light_clip_from_world(towards_light_W);
}

void ScenePass::draw_shadow(const ShadowMap& map, const Vector3& towards_light_W) {
  const int side = used_side(map);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, map.framebuffer);
  gl_.Viewport(0, 0, side, side);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Scissor(0, 0, side, side);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  gl_.Scissor(4, 4, side - 8, side - 8);  // the border stays empty
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(1.5f, 2.0f);  // for facets at grazing angles
  depth_.use();
  depth_.set(Uniform::clip_from_world, light_clip_from_world(towards_light_W));
  for (const Item& item : items_) {
    if (item.translucent) continue;
    depth_.set(Uniform::world_from_mesh, item.world_from_mesh);
    cull(item.two_sided);
    item.mesh->draw();
  }
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  gl_.Disable(GL_SCISSOR_TEST);
}

Eigen::Matrix4d ScenePass::shifted_clip(const LightSample& sample) const {
  return shift(sample.shift_px, width_, height_) * clip_from_world_;
}

void ScenePass::set_frame(const Program& program, const LightSample& sample) const {
  const ShadowMap& sky_map = sky_map_ ? *sky_map_ : key_map_;
  program.use();
  program.set(Uniform::clip_from_world, Eigen::Matrix4f(shifted_clip(sample).cast<float>()));
  program.set(Uniform::key_from_world, shadow_from_world(key_map_, sample.key_W));
  program.set(Uniform::sky_from_world, shadow_from_world(sky_map, sample.sky_W));
  program.set(Uniform::normal_offset, static_cast<float>(normal_offset()));
  program.set(Uniform::eye, Eigen::Vector3f(list_->camera.eye.cast<float>()));
  program.set(Uniform::key_direction, Eigen::Vector3f(sample.key_W.cast<float>()));
  program.set(Uniform::sky_direction, Eigen::Vector3f(sample.sky_W.cast<float>()));
  program.set(Uniform::texel, 1.0f / kKeyMapSide);
  const auto reach = [this](const ShadowMap& map) {
    return static_cast<float>(used_side(map) - 2) / static_cast<float>(map.side_px);
  };
  program.set(Uniform::shadow_reach, reach(key_map_), reach(sky_map));
  program.set(Uniform::key_shadow, kKeyUnit);
  program.set(Uniform::sky_shadow, kSkyUnit);
  gl_.ActiveTexture(GL_TEXTURE0 + kSkyUnit);
  gl_.BindTexture(GL_TEXTURE_2D, sky_map.texture);
  gl_.ActiveTexture(GL_TEXTURE0 + kKeyUnit);
  gl_.BindTexture(GL_TEXTURE_2D, key_map_.texture);
}

// Back faces of closed bodies are culled.
void ScenePass::cull(bool two_sided) const {
  two_sided ? gl_.Disable(GL_CULL_FACE) : gl_.Enable(GL_CULL_FACE);
}

void ScenePass::draw_items(const Program& program, bool translucent, bool textured) const {
  for (const Item& item : items_) {
    if (item.translucent != translucent || (item.texture != nullptr) != textured) continue;
    program.set(Uniform::world_from_mesh, item.world_from_mesh);
    program.set(Uniform::normal_from_mesh, item.normal_from_mesh);
    program.set(Uniform::color, item.color);
    program.set(Uniform::shininess, item.shininess);
    if (item.texture) gl_.BindTexture(GL_TEXTURE_2D, item.texture->id());
    cull(item.two_sided);
    item.mesh->draw();
  }
  cull(false);
}

void ScenePass::draw_solids(const LightSample& sample) const {
  set_frame(solid_, sample);
  draw_items(solid_, false);
  set_frame(textured_, sample);
  textured_.set(Uniform::picture, kPictureUnit);
  gl_.ActiveTexture(GL_TEXTURE0 + kPictureUnit);
  draw_items(textured_, false, true);
}

void ScenePass::set_backdrop(const Program& program) const {
  program.set(Uniform::background_bottom, linear(list_->background.bottom));
  program.set(Uniform::background_top, linear(list_->background.top));
  program.set(Uniform::background_ground, linear(list_->background.ground));
  program.set(Uniform::per_height, 1.0f / static_cast<float>(height_));
}

// Blends the hidden parts of overlays over the picture, without writing depth.
void ScenePass::draw_hidden(const LightSample& sample) const {
  constexpr float kCover = 0.6f;
  set_frame(translucent_, sample);
  gl_.DepthFunc(GL_GREATER);
  gl_.DepthMask(GL_FALSE);
  gl_.Enable(GL_BLEND);
  for (const Item& item : items_) {
    if (!item.seen_through) continue;
    Eigen::Vector4f color = item.color;
    color.w() *= kCover;
    translucent_.set(Uniform::world_from_mesh, item.world_from_mesh);
    translucent_.set(Uniform::normal_from_mesh, item.normal_from_mesh);
    translucent_.set(Uniform::color, color);
    item.mesh->draw();
  }
  gl_.Disable(GL_BLEND);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_LEQUAL);
}

// First the depth of all translucent bodies, then their colour where they are nearest: one surface
// per pixel. The depth offset hides a target robot that coincides with its robot.
void ScenePass::draw_translucent(const LightSample& sample) const {
  set_frame(translucent_, sample);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(1.0f, 4.0f);
  gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_items(translucent_, true);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_.Enable(GL_BLEND);
  draw_items(translucent_, true);
  gl_.Disable(GL_BLEND);
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
}

}  // namespace twinarm
