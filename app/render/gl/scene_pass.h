// ScenePass: bodies, floor and background under one light sample.
//
// Order: shadow maps of opaque bodies; opaque bodies; floor; background; parts visible through
// bodies; translucent bodies, depth first. Opaque shaders write sRGB; the last two are blended in
// linear light and encoded by the canvas. Requires a current context.
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>

#include "app/render/gl/gl_objects.h"
#include "app/render/list/draw_list.h"
#include "app/render/list/view.h"

namespace twinarm {

// Tiles of the picture where shadows can fall on the floor; the others need no shadow lookup, the
// most expensive part of a pixel.
//
// The corners of each casting box, enlarged by `margin`, are projected along the light to the plane
// z = floor_height and into the picture; its shadow lies in their convex hull. Cost: corners^2 / 2
// for each box and row of tiles.
struct CasterBox {
  Pose X_WB;                       // centre and axes
  Vector3 half = Vector3::Zero();  // of its edges [m]
};

struct FloorLight {
  Vector3 towards_light_W = Vector3::UnitZ();  // unit length
  double floor_height = 0;                     // [m]
  double margin = 0;                           // [m]
};

// In pixels from the lower left corner of the picture.
struct FloorTiles {
  int x = 0, y = 0, width = 0, height = 0;
  bool maybe_shadowed = false;
};

// They cover each pixel once.
std::vector<FloorTiles> floor_tiles(const std::vector<CasterBox>& casters, const FloorLight& light,
                                    const Eigen::Matrix4d& clip_from_world, int width, int height);

struct LightSample {
  Vector3 key_W;                                       // towards the key light, unit length
  Vector3 sky_W = Vector3::UnitZ();                    // towards the sky sample, unit length
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();  // subpixel offset of the picture
};

class ScenePass {
 public:
  // `multisampled`: 4 samples a pixel. The table must outlive the pass.
  ScenePass(const GlTable& gl, int width, int height, const ShaderVariant& variant,
            bool multisampled);

  // The list must not change until the last draw().
  void prepare(const DrawList& list);
  void draw(const LightSample& sample);
  void read(std::uint8_t* rgba) { canvas_.read(rgba); }  // bottom row first

  const Eigen::Matrix4d& clip_from_world() const { return clip_from_world_; }

 private:
  struct CachedMesh {
    CachedMesh(const GlTable& gl, std::shared_ptr<const DrawMesh> mesh)
        : source(std::move(mesh)), gpu(gl, *source), box(bounding_box(*source)) {}
    std::shared_ptr<const DrawMesh> source;  // keeps its address, the key, unique
    GpuMesh gpu;
    Eigen::AlignedBox3d box;  // in the mesh's frame
  };
  struct CachedTexture {
    CachedTexture(const GlTable& gl, std::shared_ptr<const Image> image)
        : source(std::move(image)), gpu(gl, *source) {}
    std::shared_ptr<const Image> source;
    GpuTexture gpu;
  };
  struct Item {
    const GpuMesh* mesh;
    const GpuTexture* texture;  // or none
    bool two_sided;
    Eigen::Matrix4f world_from_mesh;
    Eigen::Matrix3f normal_from_mesh;
    Eigen::Vector4f color;  // linear
    float shininess;
    bool translucent, seen_through;
  };

  struct Backdrop {
    Program floor, lit_floor, background;
  };

  void add_item(const DrawList& list, const Instance& instance);
  Eigen::Matrix4f light_clip_from_world(const Vector3& towards_light_W) const;
  Eigen::Matrix4f shadow_from_world(const ShadowMap& map, const Vector3& towards_light_W) const;
  int used_side(const ShadowMap& map) const;
  double normal_offset() const;
  void draw_shadow(const ShadowMap& map, const Vector3& towards_light_W);
  void set_frame(const Program& program, const LightSample& sample) const;
  void draw_items(const Program& program, bool translucent, bool textured = false) const;
  void cull(bool two_sided) const;
  void draw_solids(const LightSample& sample) const;
  void draw_floor(const LightSample& sample) const;
  void set_floor(const Program& program, const LightSample& sample) const;
  void draw_background(const LightSample& sample) const;
  void draw_hidden(const LightSample& sample) const;
  void draw_translucent(const LightSample& sample) const;
  void set_backdrop(const Program& program) const;
  const Backdrop& backdrop() const { return *backdrops_[has_horizon() ? 1 : 0]; }
  bool has_horizon() const { return list_->background.kind == Background::Kind::landscape; }
  Eigen::Matrix4d shifted_clip(const LightSample& sample) const;

  const GlTable& gl_;
  int width_, height_;
  Canvas canvas_;
  ShadowMap key_map_;
  std::optional<ShadowMap> sky_map_;
  ShaderVariant variant_;
  Program solid_, textured_, translucent_, depth_;
  std::array<std::optional<Backdrop>, 2> backdrops_;  // room, landscape; made on demand
  GLuint no_vertices_ = 0;  // vertex array for shaders that make their own vertices
  std::unordered_map<const DrawMesh*, CachedMesh> cache_;
  std::unordered_map<const Image*, CachedTexture> textures_;

  // Of the current frame.
  const DrawList* list_ = nullptr;
  std::vector<Item> items_;
  std::vector<CasterBox> casters_;
  SceneBounds bounds_;
  double floor_radius_ = 1;
  Eigen::Matrix4d clip_from_world_ = Eigen::Matrix4d::Identity();
};

}  // namespace twinarm
