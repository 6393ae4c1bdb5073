#include "app/page/page_layers.h"

#include <algorithm>
#include <cmath>

namespace twinarm {
namespace {

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
  json.members({{"low", low}, {"high", high}, {"twoSided", mesh.two_sided}});
  std::vector<float> uv;
  for (const auto& place : mesh.uv) uv.insert(uv.end(), place.begin(), place.end());
  bytes.add(json, "uv", uv);
  bytes.add(json, "position", position);
  bytes.add(json, "normal", normal);
  bytes.add(json, "index", index);
  json.end_object();
}

void write_textures(JsonWriter& json, PageBytes& bytes, const DrawList& list) {
  json.key("textures").begin_array();
  for (std::size_t i = 0; i < std::min(list.textures.size(), kMostTextures); ++i) {
    const std::string png = texture_file(*list.textures[i]);
    json.begin_object();
    bytes.add(json, "png", std::vector<std::uint8_t>(png.begin(), png.end()));
    json.end_object();
  }
  json.end_array();
}

void write_layer(JsonWriter& json, PageBytes& bytes, const PageLayer& layer) {
  json.begin_object();
  json.members({{"name", layer.name}, {"what", layer.what}, {"shown", layer.shown}});
  json.key("legend");
  write_legend(json, layer.legend);
  json.key("instances").begin_object();
  bytes.add(json, "first", layer.first);
  InstanceColumns::each(layer.instances, [&](const char* name, const auto& column) {
    bytes.add(json, name, column);
  });
  json.end_object();
  json.key("labels").begin_object();
  bytes.add(json, "first", layer.first_label);
  bytes.add(json, "text", layer.text);
  bytes.add(json, "position", layer.labels.position);
  bytes.add(json, "offset", layer.labels.offset);
  json.end_object();
  json.end_object();
}

}  // namespace

PageLayers::PageLayers(Stage& stage) : stage_(stage) {
  for (const LayerWords& words : layer_words({&all_overlays()})) {
    layers_.emplace_back();
    layers_.back().name = words.name;
    layers_.back().what = words.what;
  }
  std::vector<std::string> usual = usual_overlays(Overlay::Shown::on_pages);
  usual.emplace_back("bodies");
  show_at_first(usual);
}

void PageLayers::show_at_first(const std::vector<std::string>& names) {
  for (PageLayer& layer : layers_)
    layer.shown = std::find(names.begin(), names.end(), layer.name) != names.end();
}

void PageLayers::add_frame(const Moment& moment) {
  std::vector<Drawn> drawn = draw(stage_, moment, parse_overlays("all"));
  drawn.push_back(end_of_list());
  for (std::size_t i = 0; i + 1 < drawn.size(); ++i)
    add_entries(layers_[i], drawn[i], drawn[i + 1]);
}

Drawn PageLayers::end_of_list() const {
  const DrawList& list = stage_.list;
  return {nullptr, list.instances.size(), list.labels.size(), list.legend.size()};
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
    add_entries(layers_.back(), {}, end_of_list());
  }
  stage_.cast = all;
}

void PageLayers::add_entries(PageLayer& layer, const Drawn& from, const Drawn& to) {
  const DrawList& list = stage_.list;
  for (std::size_t i = from.instance; i < to.instance; ++i) layer.instances.add(list.instances[i]);
  layer.first.push_back(static_cast<std::uint32_t>(layer.instances.mesh.size()));
  for (std::size_t i = from.label; i < to.label; ++i)
    if (layer.labels.add(list.labels[i])) layer.text.push_back(number_of(list.labels[i].text));
  layer.first_label.push_back(static_cast<std::uint32_t>(layer.text.size()));
  for (std::size_t i = from.legend; i < to.legend; ++i) {
    const LegendLine& line = list.legend[i];
    const auto is_same = [&](const LegendLine& other) { return other.words() == line.words(); };
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
  json.key("meshes").list(stage_.list.meshes,
                          [&](const auto& mesh) { write_mesh(json, bytes, *mesh); });
  write_textures(json, bytes, stage_.list);
  json.key("layers").list(layers_,
                          [&](const PageLayer& layer) { write_layer(json, bytes, layer); });
  json.key("texts").texts(texts_);
}

}  // namespace twinarm
