// DrawList: contents of a picture for all painters (OSMesa here, three.js in the browser).
//
// World frame W: z up, right-handed, metres, radians. Colours: sRGB in 0..1; alpha < 1:
// translucent. Pixels: from the top left, y down, of a picture of 1280 x 720; painters scale them.
//
// Meshes stay registered; clear_frame() removes their instances. Meshes are shared and immutable:
// copies of a list are cheap, and a painter may identify a mesh by its address.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "app/render/list/draw_mesh.h"
#include "app/render/list/image.h"

namespace twinarm {

struct Color {
  float r = 0, g = 0, b = 0, a = 1;
};

using MeshId = std::size_t;     // index into DrawList::meshes
using TextureId = std::size_t;  // index into DrawList::textures

// A placed mesh: p_W = X_WM * (scale * p_M), componentwise.
struct Instance {
  MeshId mesh = 0;
  Pose X_WM;
  Vector3 scale = Vector3::Ones();  // positive
  Color color{0.7f, 0.7f, 0.7f, 1.0f};
  float shininess = 0.35f;           // 0 = chalk, 1 = polished
  bool seen_through = false;         // faintly visible behind or inside bodies
  std::optional<TextureId> texture;  // times the colour, if the mesh has uv and is opaque
  int body = -1;                     // it belongs to, for picking; -1: none
};

// A line of text (UTF-8), never hidden by bodies.
struct Label {
  enum class Anchor { world, screen };
  std::string text;
  Anchor anchor = Anchor::world;
  Vector3 p_W = Vector3::Zero();  // labelled point of a world label
  // World: from the point's pixel to the text, with a thin line. Screen: from the top left corner,
  // or from bottom or right if negative.
  Eigen::Vector2d offset_px = Eigen::Vector2d::Zero();
  double size_px = 15;
  Color color{0.10f, 0.12f, 0.15f, 1.0f};
};

// An entry of the legend, at the bottom left.
struct LegendLine {
  Color color;  // of the swatch
  std::string text;
  std::string value = {};       // appended; may change between frames
  std::vector<Color> bar = {};  // from 0 to the value: a colour bar instead of the swatch
  std::string words() const { return text + value; }
};

// A filled box below all text: bars and panels.
struct ScreenBox {
  // Top left corner, as the offset of a screen label; size.
  Eigen::Vector2d corner_px = Eigen::Vector2d::Zero(), size_px = Eigen::Vector2d::Zero();
  Color color;
};

struct Camera {
  Vector3 eye = Vector3(1.6, -2.0, 1.2);
  Vector3 target = Vector3::Zero();
  Vector3 up = Vector3::UnitZ();
  double field_of_view = 0.55;  // vertical [rad]
};

// The floor z = height with a metric grid that fades with distance.
struct Ground {
  bool visible = true;
  double height = 0;        // [m]
  double cell = 0.1;        // between thin lines [m]
  int cells_per_major = 5;  // between strong lines
};

// A room (by default): a gradient from the bottom to the top of the picture, also on the floor. A
// landscape: sky and ground with haze at the horizon.
struct Background {
  enum class Kind { room, landscape };
  Kind kind = Kind::room;
  Color bottom{0.87f, 0.875f, 0.88f, 1.0f};  // horizon of a landscape
  Color top{0.56f, 0.595f, 0.635f, 1.0f};    // zenith
  Color ground{0.62f, 0.63f, 0.63f, 1.0f};   // fully lit; of a landscape only
};
Background sky_background();
Background white_background();

class DrawList {
 public:
  std::vector<std::shared_ptr<const DrawMesh>> meshes;  // append only, by the functions below
  std::vector<std::shared_ptr<const Image>> textures;   // append only; alpha is ignored
  std::vector<Instance> instances;
  std::vector<Label> labels;
  std::string title;
  std::vector<LegendLine> legend;
  std::vector<ScreenBox> bars;
  Camera camera;
  Vector3 light_W = Vector3(-0.45, -0.62, 1.0);  // towards the light, any length
  Ground ground;
  Background background;

  MeshId register_mesh(const TriangleMesh& mesh) { return register_mesh(make_draw_mesh(mesh)); }
  MeshId register_mesh(DrawMesh mesh);
  TextureId register_texture(std::shared_ptr<const Image> texture);
  MeshId unit_mesh(UnitShape shape);  // registered at its first use
  MeshId unit_spring(double aspect);  // the nearest of a few aspects
  void clear_frame();                 // instances, labels, bars, title, legend

 private:
  std::map<UnitShape, MeshId> units_;
  std::map<int, MeshId> springs_;  // by log2 of the aspect, in halves
};

// Instances added during its lifetime belong to that body.
class OfBody {
 public:
  OfBody(DrawList& list, std::size_t body)
      : list_(list), first_(list.instances.size()), body_(static_cast<int>(body)) {}
  ~OfBody() {
    for (std::size_t i = first_; i < list_.instances.size(); ++i) list_.instances[i].body = body_;
  }
  OfBody(const OfBody&) = delete;

 private:
  DrawList& list_;
  std::size_t first_;
  int body_;
};

// Add instances, except those that are not finite or have no extent (zero force).
void add_mesh_instance(DrawList& list, MeshId mesh, const Pose& X_WM, const Color& color,
                       const Vector3& scale = Vector3::Ones(), float shininess = 0.35f);
void add_box(DrawList& list, const Pose& X_WM, const Vector3& size, const Color& color);
void add_sphere(DrawList& list, const Vector3& p_W, double radius, const Color& color);
void add_rod(DrawList& list, const Vector3& from_W, const Vector3& to_W, double radius,
             const Color& color);
void add_spring(DrawList& list, const Vector3& from_W, const Vector3& to_W, double radius,
                const Color& color);
// `radius` is the shaft's; the head is 2.4 times as wide and ends at `to_W`.
void add_arrow(DrawList& list, const Vector3& from_W, const Vector3& to_W, double radius,
               const Color& color);
void add_label(DrawList& list, const Vector3& p_W, const std::string& text,
               const Eigen::Vector2d& offset_px = Eigen::Vector2d(10, -10), double size_px = 15);

}  // namespace twinarm
