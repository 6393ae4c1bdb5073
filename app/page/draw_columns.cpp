#include "app/page/draw_columns.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace twinarm {
namespace {

constexpr std::uint8_t kSeenThrough = 1;
constexpr int kWidestTexture = 1024;  // [px]; wider ones are halved: a page goes by mail

std::uint8_t byte_of(float share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0f, 1.0f)));
}

template <class Vector>
void append_vector(std::vector<float>& column, const Vector& v) {
  for (int c = 0; c < 3; ++c) column.push_back(static_cast<float>(v[c]));
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

}  // namespace

void InstanceColumns::add(const Instance& instance) {
  mesh.push_back(static_cast<std::uint16_t>(instance.mesh));
  flags.push_back(instance.seen_through ? kSeenThrough : 0);
  shininess.push_back(byte_of(instance.shininess));
  texture.push_back(static_cast<std::uint8_t>(
      instance.texture && *instance.texture < kMostTextures ? *instance.texture + 1 : 0));
  const Color& c = instance.color;
  for (const float share : {c.r, c.g, c.b, c.a}) color.push_back(byte_of(share));
  append_vector(position, instance.X_WM.p);
  append_vector(scale, instance.scale);
  const Eigen::Quaterniond q(instance.X_WM.R);
  for (const double part : {q.x(), q.y(), q.z(), q.w()})
    turn.push_back(static_cast<std::int16_t>(std::lround(32767 * part)));
}

bool LabelColumns::add(const Label& label) {
  if (label.anchor != Label::Anchor::world || !label.p_W.allFinite()) return false;
  append_vector(position, label.p_W);
  for (int c = 0; c < 2; ++c)
    offset.push_back(static_cast<std::int16_t>(std::lround(label.offset_px[c])));
  return true;
}

std::size_t append_array(std::string& bytes, const void* data, std::size_t size) {
  bytes.resize((bytes.size() + 7) / 8 * 8);
  const std::size_t at = bytes.size();
  bytes.append(static_cast<const char*>(data), size);
  return at;
}

std::vector<LayerWords> layer_words(const std::vector<const std::vector<Overlay>*>& overlays) {
  std::vector<LayerWords> words{{"bodies", "robots, bodies and obstacles"}};
  for (const auto* some : overlays)
    for (const Overlay& overlay : *some) words.push_back({overlay.name, overlay.what});
  return words;
}

std::string texture_file(const Image& image) {
  Image small = image;
  while (std::max(small.width, small.height) > kWidestTexture) small = halved(small);
  return encode_png(small);
}

void write_color(JsonWriter& json, const char* key, const Color& color) {
  json.key(key).begin_array();
  for (const float part : {color.r, color.g, color.b}) json.count(byte_of(part));
  json.end_array();
}

void write_legend(JsonWriter& json, const std::vector<LegendLine>& legend) {
  json.list(legend, [&](const LegendLine& line) {
    json.begin_object();
    write_color(json, "color", line.color);
    json.key("text").text(line.words());
    json.end_object();
  });
}

void write_view(JsonWriter& json, const Stage& stage) {
  const Camera& camera = stage.list.camera;
  const Ground& ground = stage.list.ground;
  json.key("view").begin_object();
  json.members({{"eye", camera.eye},
                {"target", camera.target},
                {"up", camera.up},
                {"fieldOfView", camera.field_of_view},
                {"light", stage.list.light_W},
                {"radius", stage.extent.radius()}});
  write_color(json, "bottom", stage.list.background.bottom);
  write_color(json, "top", stage.list.background.top);
  json.key("ground").object({{"visible", ground.visible},
                             {"height", ground.height},
                             {"cell", ground.cell},
                             {"cellsPerMajor", ground.cells_per_major}});
  json.end_object();
}

}  // namespace twinarm
