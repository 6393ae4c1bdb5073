#include "app/web/page_layers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "app/show/overlays.h"

namespace twinarm {
namespace {

constexpr std::uint8_t kSeenThrough = 1;
constexpr std::size_t kMostTextures = 255;
constexpr int kWidestTexture = 1024;  // [px]; wider ones are halved: a page goes by mail

std::uint8_t byte_of(float share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0f, 1.0f)));
}

template <class Vector>
void append(std::vector<float>& column, const Vector& v) {
  for (int c = 0; c < 3; ++c) column.push_back(static_cast<float>(v[c]));
}

void append_instance(PageLayer& layer, const Instance& instance) {
  layer.mesh.push_back(static_cast<std::uint16_t>(instance.mesh));
  layer.flags.push_back(instance.seen_through ? kSeenThrough : 0);
  layer.shininess.push_back(byte_of(instance.shininess));
  layer.texture.push_back(static_cast<std::uint8_t>(
      instance.texture && *instance.texture < kMostTextures ? *instance.texture + 1 : 0));
  const Color& color = instance.color;
  for (const float share : {color.r, color.g, color.b, color.a})
    layer.color.push_back(byte_of(share));
  append(layer.position, instance.X_WM.p);
  append(layer.scale, instance.scale);
  const Eigen::Quaterniond turn(instance.X_WM.R);
  for (const double part : {turn.x(), turn.y(), turn.z(), turn.w()})
    layer.turn.push_back(static_cast<std::int16_t>(std::lround(32767 * part)));
}

// Positions in shares of the box (a millionth of a metre on a robot), normals in bytes, each index
// less the one before it: numbers that repeat are packed best.
void write_mesh(JsonWriter& json, PageBytes& bytes, const DrawMesh& mesh) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e30), high = -low;
  for (const auto& p : mesh.positions)
    for (int c = 0; c < 3; ++c) {
      const double value = p[static_cast<std::size_t>(c)];
      low[c] = std::min(low[c], value);
      high[c] = std::max(high[c], value);
    }
  if (mesh.positions.empty()) low = high = Eigen::Vector3d::Zero();
  std::vector<std::uint16_t> position;
  std::vector<std::int8_t> normal;
  std::vector<std::uint32_t> index;
  for (const auto& p : mesh.positions)
    for (int c = 0; c < 3; ++c) {
      const double size = high[c] - low[c];
      const double share = size > 0 ? (p[static_cast<std::size_t>(c)] - low[c]) / size : 0;
      position.push_back(static_cast<std::uint16_t>(std::lround(65535 * share)));
    }
  for (const auto& n : mesh.normals)
    for (const float part : n) normal.push_back(static_cast<std::int8_t>(std::lround(127 * part)));
  std::uint32_t last = 0;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) {
      index.push_back(vertex - last);
      last = vertex;
    }
  json.begin_object();
  json.key("low").vector(low);
  json.key("high").vector(high);
  json.key("twoSided").boolean(mesh.two_sided);
  std::vector<float> uv;
  for (const auto& place : mesh.uv) uv.insert(uv.end(), place.begin(), place.end());
  bytes.add(json, "uv", uv);
  bytes.add(json, "position", position);
  bytes.add(json, "normal", normal);
  bytes.add(json, "index", index);
  json.end_object();
}

// The mean of four pixels each.
Image halved(const Image& image) {
  Image half;
  half.width = std::max(1, image.width / 2);
  half.height = std::max(1, image.height / 2);
  half.rgba.resize(std::size_t{4} * static_cast<std::size_t>(half.width) *
                   static_cast<std::size_t>(half.height));
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (int c = 0; c < 4; ++c) {
        int sum = 2;
        for (const int dy : {0, 1})
          for (const int dx : {0, 1})
            sum += image.pixel(std::min(2 * x + dx, image.width - 1),
                               std::min(2 * y + dy, image.height - 1))[c];
        half.pixel(x, y)[c] = static_cast<std::uint8_t>(sum / 4);
      }
  return half;
}

void write_textures(JsonWriter& json, PageBytes& bytes, const DrawList& list) {
  json.key("textures").begin_array();
  for (std::size_t i = 0; i < std::min(list.textures.size(), kMostTextures); ++i) {
    Image image = *list.textures[i];
    while (std::max(image.width, image.height) > kWidestTexture) image = halved(image);
    const std::string png = encode_png(image);
    json.begin_object();
    bytes.add(json, "png", std::vector<std::uint8_t>(png.begin(), png.end()));
    json.end_object();
  }
  json.end_array();
}

void write_color(JsonWriter& json, const char* key, const Color& color) {
  json.key(key).begin_array();
  for (const float part : {color.r, color.g, color.b}) json.count(byte_of(part));
  json.end_array();
}

void write_layer(JsonWriter& json, PageBytes& bytes, const PageLayer& layer) {
  json.begin_object();
  json.key("name").text(layer.name);
  json.key("what").text(layer.what);
  json.key("shown").boolean(layer.shown);
  json.key("legend").begin_array();
  for (const LegendLine& line : layer.legend) {
    json.begin_object();
    write_color(json, "color", line.color);
    json.key("text").text(line.text);
    json.end_object();
  }
  json.end_array();
  json.key("instances").begin_object();
  bytes.add(json, "first", layer.first);
  bytes.add(json, "mesh", layer.mesh);
  bytes.add(json, "flags", layer.flags);
  bytes.add(json, "shininess", layer.shininess);
  bytes.add(json, "color", layer.color);
  bytes.add(json, "texture", layer.texture);
  bytes.add(json, "position", layer.position);
  bytes.add(json, "turn", layer.turn);
  bytes.add(json, "scale", layer.scale);
  json.end_object();
  json.key("labels").begin_object();
  bytes.add(json, "first", layer.first_label);
  bytes.add(json, "text", layer.text);
  bytes.add(json, "position", layer.label_position);
  bytes.add(json, "offset", layer.label_offset);
  json.end_object();
  json.end_object();
}

}  // namespace

PageLayers::PageLayers(Stage& stage) : stage_(stage) {
  layers_.emplace_back();
  layers_.back().name = "bodies";
  layers_.back().what = "robots, bodies and obstacles";
  for (const Overlay& overlay : all_overlays()) {
    layers_.emplace_back();
    PageLayer& layer = layers_.back();
    layer.name = overlay.name;
    layer.what = overlay.what;
  }
  show_at_first({"bodies", "ghost", "couplings", "contacts"});
}

void PageLayers::show_at_first(const std::vector<std::string>& names) {
  for (PageLayer& layer : layers_)
    layer.shown = std::find(names.begin(), names.end(), layer.name) != names.end();
}

void PageLayers::add_frame(const Moment& moment) {
  draw(stage_, moment, {});
  const std::size_t bodies = stage_.list.instances.size(), labels = stage_.list.labels.size();
  add_entries(layers_.front(), 0, 0);
  for (std::size_t i = 1; i < layers_.size(); ++i) {
    draw(stage_, moment, {layers_[i].name});
    add_entries(layers_[i], bodies, labels);
  }
}

// Of the cast only one body's parts are on stage at a time.
void PageLayers::add_apart(const Moment& moment) {
  const Cast all = stage_.cast;
  for (std::size_t body = 0; body < stage_.model->parent.size(); ++body) {
    Cast& cast = stage_.cast;
    cast.ties.clear();
    cast.parts.clear();
    cast.planes.clear();
    for (const CastPart& part : all.parts)
      if (part.body == body) cast.parts.push_back(part);
    for (const CastPlane& plane : all.planes)
      if (plane.body == body) cast.planes.push_back(plane);
    draw(stage_, moment, {});
    layers_.emplace_back();
    layers_.back().name = "body/" + (body == 0 ? "world" : stage_.model->body_name[body]);
    add_entries(layers_.back(), 0, 0);
  }
  stage_.cast = all;
}

void PageLayers::add_entries(PageLayer& layer, std::size_t first_instance,
                             std::size_t first_label) {
  const DrawList& list = stage_.list;
  for (std::size_t i = first_instance; i < list.instances.size(); ++i)
    append_instance(layer, list.instances[i]);
  layer.first.push_back(static_cast<std::uint32_t>(layer.mesh.size()));
  for (std::size_t i = first_label; i < list.labels.size(); ++i) {
    const Label& label = list.labels[i];
    if (label.anchor != Label::Anchor::world || !label.p_W.allFinite()) continue;
    layer.text.push_back(number_of(label.text));
    append(layer.label_position, label.p_W);
    for (int c = 0; c < 2; ++c)
      layer.label_offset.push_back(static_cast<std::int16_t>(std::lround(label.offset_px[c])));
  }
  layer.first_label.push_back(static_cast<std::uint32_t>(layer.text.size()));
  for (const LegendLine& line : list.legend) {
    const auto is_same = [&](const LegendLine& other) { return other.text == line.text; };
    if (std::none_of(layer.legend.begin(), layer.legend.end(), is_same))
      layer.legend.push_back(line);
  }
}

std::uint32_t PageLayers::number_of(const std::string& text) {
  const auto [place, is_new] =
      numbers_.try_emplace(text, static_cast<std::uint32_t>(texts_.size()));
  if (is_new) texts_.push_back(text);
  return place->second;
}

void PageLayers::write(JsonWriter& json, PageBytes& bytes) const {
  json.key("meshes").begin_array();
  for (const auto& mesh : stage_.list.meshes) write_mesh(json, bytes, *mesh);
  json.end_array();
  write_textures(json, bytes, stage_.list);
  json.key("layers").begin_array();
  for (const PageLayer& layer : layers_) write_layer(json, bytes, layer);
  json.end_array();
  json.key("texts").texts(texts_);
}

void write_view(JsonWriter& json, const Stage& stage) {
  const Camera& camera = stage.list.camera;
  const Ground& ground = stage.list.ground;
  json.key("view").begin_object();
  json.key("eye").vector(camera.eye);
  json.key("target").vector(camera.target);
  json.key("up").vector(camera.up);
  json.key("fieldOfView").number(camera.field_of_view);
  json.key("light").vector(stage.list.light_W);
  json.key("radius").number(stage.extent.radius());
  write_color(json, "bottom", stage.list.background.bottom);
  write_color(json, "top", stage.list.background.top);
  json.key("ground").begin_object();
  json.key("visible").boolean(ground.visible);
  json.key("height").number(ground.height);
  json.key("cell").number(ground.cell);
  json.key("cellsPerMajor").count(ground.cells_per_major);
  json.end_object();
  json.end_object();
}

}  // namespace twinarm
