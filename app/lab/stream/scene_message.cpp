

#include "app/lab/stream/lab_view.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

const std::vector<LayerWords>& lab_layers() {
  static const std::vector<LayerWords> all = layer_words({&all_overlays(), &live_overlays()});
  return all;
}

void write_layers(JsonWriter& json, const std::vector<std::vector<LegendLine>>& legends) {
  auto legend = legends.begin();
  json.key("layers").list(lab_layers(), [&](const LayerWords& layer) {
    json.object({{"name", layer.name}, {"what", layer.what}, {"legend", [&] {
                                                                write_legend(json, *legend++);
                                                              }}});
  });
}

void write_bodies(JsonWriter& json, const SimulatePlan& plan) {
  const Model<double>& model = plan.input.robot.model;
  const std::vector<char> moves = bodies_with_dofs(model);
  const int links = plan.input.scene ? plan.input.scene->robot_bodies : model.body_count() - 1;
  json.key("bodies").begin_array();
  for (std::size_t i = 0; i < model.parent.size(); ++i)
    json.object({{"name", i == 0 ? "world" : model.body_name[i]},
                 {"moves", moves[i] != 0},
                 {"robot", i > 0 && static_cast<int>(i) <= links}});
  json.end_array();
}

bool turns_or_slides(JointDescription::Type type) {
  using Type = JointDescription::Type;
  return type == Type::revolute || type == Type::continuous || type == Type::prismatic;
}

void write_joints(JsonWriter& json, const RobotInput& robots, const std::vector<int>& driven) {
  json.key("joints").list(robots.coordinates.all(), [&](const NamedJoint& joint) {
    if (joint.components().size() != 1) return;
    json.begin_object();
    json.members({{"name", joint.name}, {"body", joint.body}});
    const auto& all = robots.robot.joints;
    const auto found = std::ranges::find(all, joint.name, &JointDescription::name);
    if (found != all.end() && found->is_limited()) {
      if (std::isfinite(found->lower)) json.key("low").number(found->lower);
      if (std::isfinite(found->upper)) json.key("high").number(found->upper);
    }
    if (found != all.end() && turns_or_slides(found->type))
      json.members(
          {{"axis", found->axis}, {"slides", found->type == JointDescription::Type::prismatic}});
    const auto place = std::ranges::find(driven, static_cast<int>(joint.body));
    if (place != driven.end()) json.key("driven").count(place - driven.begin());
    json.end_object();
  });
}

// u32 vertices, indices, flags (1: two-sided, 2: has uv), 0; then positions, normals, uv, indices.
std::string mesh_bytes(const DrawMesh& mesh) {
  const std::vector<std::uint32_t> head{static_cast<std::uint32_t>(mesh.positions.size()),
                                        static_cast<std::uint32_t>(3 * mesh.triangles.size()),
                                        (mesh.two_sided ? 1u : 0u) | (mesh.uv.empty() ? 0u : 2u),
                                        0u};
  std::string bytes;
  const auto append = [&](const auto&... all) {  // in this order
    (bytes.append(reinterpret_cast<const char*>(all.data()), all.size() * sizeof(*all.data())),
     ...);
  };
  append(head, mesh.positions, mesh.normals, mesh.uv, mesh.triangles);
  return bytes;
}

}  // namespace

const std::vector<std::string>& layer_names() {
  static const std::vector<std::string> names = names_of(lab_layers());
  return names;
}

std::string LabView::scene_message() const {
  return json_text([&](JsonWriter& json) {
    json.members({{"kind", "scene"},
                  {"scene", columns_.scene},
                  {"title", words_.title.empty() ? stage_.name : words_.title},
                  {"file", words_.file},
                  {"look", words_.look},
                  {"meshes", store_.meshes()},
                  {"textures", store_.textures()}});
    write_layers(json, legends_);
    json.key("channels").list(channels_.all(), [&](const RunColumn& channel) {
      json.object([&] { write_channel(json, channel); });
    });
    json.key("energy_balance").texts(rows_);
    write_bodies(json, *plan_);
    const InputOverride* input = snapshots_.input_override();
    write_joints(json, plan_->input.robot, input ? input->driven() : std::vector<int>{});
    if (const auto tip = input ? input->tip() : std::nullopt)
      json.key("tip").object({{"body", tip->first}, {"p", tip->second}});
    write_view(json, stage_);
  });
}

bool MeshStore::take(const DrawList& list) {
  const std::size_t before = mesh_names_.size() + texture_names_.size();
  while (mesh_names_.size() < list.meshes.size())
    mesh_names_.push_back(keep(mesh_bytes(*list.meshes[mesh_names_.size()])));
  while (texture_names_.size() < std::min(list.textures.size(), kMaxTextures))
    texture_names_.push_back(keep(texture_file(*list.textures[texture_names_.size()])));
  return mesh_names_.size() + texture_names_.size() > before;
}

// Returns its name: a hash of 128 bits in hexadecimal.
std::string MeshStore::keep(std::string bytes) {
  std::string name =
      fmt::format("{:016x}{:016x}", hash_of(bytes), hash_of(bytes, 0x9ae16a3b2f90404fu));
  files_.try_emplace(name, std::make_shared<const std::string>(std::move(bytes)));
  return name;
}

std::shared_ptr<const std::string> MeshStore::file(const std::string& name) const {
  const auto found = files_.find(name);
  return found == files_.end() ? nullptr : found->second;
}

}  // namespace twinarm
