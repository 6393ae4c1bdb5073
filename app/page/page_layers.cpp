#include "app/page/page_layers.h"

namespace twinarm {
namespace {

// Positions in 16 bits of the bounding box, normals in bytes, differences of indices: they
// compress well.
void write_mesh(JsonWriter& json, PageBytes& bytes, const DrawMesh& mesh) {
  Eigen::AlignedBox3d box = bounding_box(mesh);
  if (mesh.positions.empty()) box.extend(Eigen::Vector3d::Zero());
  const Eigen::Vector3d low = box.min(), high = box.max(), size = box.sizes();
  std::vector<std::uint16_t> position;
  std::vector<std::int8_t> normal;
  std::vector<std::uint32_t> index;
  for (const auto& p : mesh.positions)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto i = static_cast<Eigen::Index>(c);
      const double share = size[i] > 0 ? (p[c] - low[i]) / size[i] : 0;
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
  std::vector<float> uv;
  for (const auto& place : mesh.uv) uv.insert(uv.end(), place.begin(), place.end());
  json.object([&] {
    json.members({{"low", low}, {"high", high}, {"twoSided", mesh.two_sided}});
    bytes.add(json, "uv", uv);
    bytes.add(json, "position", position);
    bytes.add(json, "normal", normal);
    bytes.add(json, "index", index);
  });
}

void write_textures(JsonWriter& json, PageBytes& bytes, const DrawList& list) {
  json.key("textures").begin_array();
  for (std::size_t i = 0; i < std::min(list.textures.size(), kMaxTextures); ++i) {
    const std::string png = texture_file(*list.textures[i]);
    json.object([&] { bytes.add(json, "png", std::vector<std::uint8_t>(png.begin(), png.end())); });
  }
  json.end_array();
}

void write_layer(JsonWriter& json, PageBytes& bytes, const PageLayer& layer) {
  json.begin_object();
  json.members({{"name", layer.name}, {"what", layer.what}, {"shown", layer.shown}});
  json.key("legend");
  write_legend(json, layer.legend);
  json.key("instances").object([&] {
    bytes.add(json, "first", layer.first);
    InstanceColumns::each(layer.instances, [&](const char* name, const auto& column) {
      bytes.add(json, name, column);
    });
  });
  json.key("labels").object([&] {
    bytes.add(json, "first", layer.first_label);
    bytes.add(json, "text", layer.text);
    bytes.add(json, "position", layer.labels.position);
    bytes.add(json, "offset", layer.labels.offset);
  });
  json.end_object();
}

constexpr std::uint8_t kSeenThrough = 1;
constexpr int kMaxTextureWidth = 1024;  // [px]; wider ones are halved

std::uint8_t byte_of(float share) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0f, 1.0f)));
}

template <class Vector>
void append_vector(std::vector<float>& column, const Vector& v) {
  for (int c = 0; c < 3; ++c) column.push_back(static_cast<float>(v[c]));
}

// Mean of four pixels each.
Image halved(const Image& image) {
  Image half = make_image(std::max(1, image.width / 2), std::max(1, image.height / 2));
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

PageLayers::PageLayers(SceneView& view) : view_(view) {
  for (const LayerWords& words : layer_words({&all_overlays()}))
    static_cast<LayerWords&>(layers_.emplace_back()) = words;
  std::vector<std::string> usual = usual_overlays(Overlay::Shown::on_pages);
  usual.emplace_back("bodies");
  show_at_first(usual);
}

void PageLayers::show_at_first(const std::vector<std::string>& names) {
  for (PageLayer& layer : layers_)
    layer.shown = std::ranges::find(names, layer.name) != names.end();
}

void PageLayers::add_frame(const Snapshot& snapshot) {
  const std::vector<Drawn> drawn = draw(view_, snapshot, parse_overlays("all"));
  for (std::size_t i = 0; i + 1 < drawn.size(); ++i)
    add_entries(layers_[i], drawn[i], drawn[i + 1]);
}

// Of the cast only one body's parts are on stage at a time.
void PageLayers::add_apart(const Snapshot& snapshot) {
  const SceneMeshes all = view_.cast;
  for (std::size_t body = 0; body < view_.model->parent.size(); ++body) {
    view_.cast = all;
    view_.cast.ties.clear();
    const auto is_other = [&](const auto& part) { return part.body != body; };
    std::erase_if(view_.cast.parts, is_other);
    std::erase_if(view_.cast.planes, is_other);
    const std::vector<Drawn> drawn = draw(view_, snapshot, {});
    layers_.emplace_back().name = "body/" + (body == 0 ? "world" : view_.model->body_name[body]);
    add_entries(layers_.back(), drawn[0], drawn[1]);
  }
  view_.cast = all;
}

void PageLayers::add_entries(PageLayer& layer, const Drawn& from, const Drawn& to) {
  const DrawList& list = view_.list;
  for (std::size_t i = from.instance; i < to.instance; ++i) layer.instances.add(list.instances[i]);
  layer.first.push_back(static_cast<std::uint32_t>(layer.instances.mesh.size()));
  for (std::size_t i = from.label; i < to.label; ++i)
    if (layer.labels.add(list.labels[i])) layer.text.push_back(number_of(list.labels[i].text));
  layer.first_label.push_back(static_cast<std::uint32_t>(layer.text.size()));
  for (std::size_t i = from.legend; i < to.legend; ++i) {
    const LegendLine& line = list.legend[i];
    const auto is_same = [&](const LegendLine& other) { return other.words() == line.words(); };
    if (std::ranges::none_of(layer.legend, is_same)) layer.legend.push_back(line);
  }
}

std::uint32_t PageLayers::number_of(const std::string& text) {
  const auto [place, is_new] =
      numbers_.try_emplace(text, static_cast<std::uint32_t>(texts_.size()));
  if (is_new) texts_.push_back(text);
  return place->second;
}

void PageLayers::write(JsonWriter& json, PageBytes& bytes) const {
  json.key("meshes").list(view_.list.meshes,
                          [&](const auto& mesh) { write_mesh(json, bytes, *mesh); });
  write_textures(json, bytes, view_.list);
  json.key("layers").list(layers_,
                          [&](const PageLayer& layer) { write_layer(json, bytes, layer); });
  json.key("texts").texts(texts_);
}

void InstanceColumns::add(const Instance& instance) {
  mesh.push_back(static_cast<std::uint16_t>(instance.mesh));
  flags.push_back(instance.seen_through ? kSeenThrough : 0);
  shininess.push_back(byte_of(instance.shininess));
  texture.push_back(static_cast<std::uint8_t>(
      instance.texture && *instance.texture < kMaxTextures ? *instance.texture + 1 : 0));
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
  while (std::max(small.width, small.height) > kMaxTextureWidth) small = halved(small);
  return encode_png(small);
}

void write_color(JsonWriter& json, const Color& color) {
  json.value(std::array{byte_of(color.r), byte_of(color.g), byte_of(color.b)});
}

void write_legend(JsonWriter& json, const std::vector<LegendLine>& legend) {
  json.list(legend, [&](const LegendLine& line) {
    json.begin_object();
    write_color(json.key("color"), line.color);
    if (!line.bar.empty())
      json.key("bar").list(line.bar, [&](const Color& color) { write_color(json, color); });
    json.key("text").text(line.words());
    json.end_object();
  });
}

void write_view(JsonWriter& json, const SceneView& view) {
  const Camera& camera = view.list.camera;
  const Ground& ground = view.list.ground;
  json.key("view").begin_object();
  json.members({{"eye", camera.eye},
                {"target", camera.target},
                {"fieldOfView", camera.field_of_view},
                {"light", view.list.light_W},
                {"radius", view.extent.radius()}});
  write_color(json.key("bottom"), view.list.background.bottom);
  write_color(json.key("top"), view.list.background.top);
  json.key("ground").object({{"visible", ground.visible},
                             {"height", ground.height},
                             {"cell", ground.cell},
                             {"cellsPerMajor", ground.cells_per_major}});
  json.end_object();
}

}  // namespace twinarm
