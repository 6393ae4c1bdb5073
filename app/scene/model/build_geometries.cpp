// Geometries, their surfaces, and the pairs without contacts.

#include "app/scene/model/scene_builder.h"
#include "collision/contact/contact_constraints.h"

namespace twinarm {
namespace {

bool is_moved_by_forces(const Model<double>& model, int root) {
  return root > 0 && model.joint[static_cast<std::size_t>(root)] != JointType::prescribed;
}

template <class T>
void replace_by(std::optional<T>& value, const std::optional<T>& given) {
  if (given) value = given;
}

struct GeometryBuilder {
  SceneModel& scene;
  std::vector<SceneReference> owners{};  // by geometry

  void build() {
    for (std::size_t r = 0; r < description().robots.size(); ++r) add_robot(r);
    for (std::size_t b = 0; b < description().bodies.size(); ++b) {
      const BodyDescription& body = description().bodies[b];
      const int index = body_of(scene, {static_cast<int>(b), -1, ""});
      add({body.surface, body.name, index, index == 0 ? body.X_WB : Pose{}, body.shape, body.group,
           -1},
          {static_cast<int>(b), -1, ""});
    }
    constexpr std::size_t kMaxGeometries = 10000;
    if (scene.geometries.size() > kMaxGeometries)
      throw InputError(
          {{description().file.string(), 0, "", "there are more than 10,000 shapes that may touch",
            "give fewer bodies, or robots with collide = false", "scene.too-many"}});
    find_roots();
    for (const PairDescription& pair : description().pairs) add_pair(pair);
  }

  const SceneDescription& description() const { return scene.description; }

  void add_robot(std::size_t r) {
    const RobotInScene& robot = description().robots[r];
    if (!robot.collide) return;
    for (const LinkDescription& link : robot.description.links)
      for (const CollisionPart& part : link.collisions) {
        const SceneReference owner{-1, static_cast<int>(r), link.name};
        SceneGeometry geometry{robot.surface,         name_in_scene(description(), r, link.name),
                               body_of(scene, owner), part.X_LG(),
                               part.geometry,         0,
                               static_cast<int>(r)};
        add(std::move(geometry), owner);
      }
  }

  void add(SceneGeometry geometry, SceneReference owner) {
    scene.geometries.push_back(std::move(geometry));
    owners.push_back(std::move(owner));
  }

  std::vector<int> named(const std::string& name) const {
    const SceneReference wanted = *find_reference(description(), name);
    std::vector<int> found;
    for (std::size_t g = 0; g < owners.size(); ++g)
      if (owners[g].body == wanted.body && owners[g].robot == wanted.robot &&
          (wanted.link.empty() || owners[g].link == wanted.link))
        found.push_back(static_cast<int>(g));
    return found;
  }

  void find_roots() {
    const Model<double>& model = scene.model;
    std::vector<int>& roots = scene.roots;
    for (int i = 0; i < model.body_count(); ++i) {
      const auto body = static_cast<std::size_t>(i);
      const bool is_fixed = i > 0 && model.joint[body] == JointType::fixed;
      roots.push_back(is_fixed ? roots[static_cast<std::size_t>(model.parent[body])] : i);
    }
    for (const SceneConstraint& c : scene.constraints) {
      const LoopTypeFacts& facts = facts_of(c.type);
      if (facts.ends == LoopBetween::bodies && facts.rows >= 3)  // a joint
        scene.joined.insert(std::minmax(roots[static_cast<std::size_t>(c.a)],
                                        roots[static_cast<std::size_t>(c.b)]));
    }
  }

  // Later pairs replace what earlier ones give.
  void add_pair(const PairDescription& given) {
    const std::vector<int> all_a = named(given.a), all_b = named(given.b);
    for (const int a : all_a)
      for (const int b : all_b) {
        PairOverride& pair = scene.pairs[std::minmax(a, b)];
        replace_by(pair.friction, given.friction);
        replace_by(pair.restitution, given.restitution);
        replace_by(pair.stiffness, given.stiffness);
        replace_by(pair.dissipation, given.dissipation);
        replace_by(pair.collide, given.collide);
      }
  }
};

}  // namespace

void build_geometries(SceneModel& scene) {
  GeometryBuilder{scene}.build();
}

bool SceneModel::is_apart(int a, int b) const {
  const SceneGeometry &s = geometries[static_cast<std::size_t>(a)],
                      &t = geometries[static_cast<std::size_t>(b)];
  const auto root_of = [&](int body) { return roots[static_cast<std::size_t>(body)]; };
  const auto parent_of = [&](int root) {
    return root == 0 ? 0 : root_of(model.parent[static_cast<std::size_t>(root)]);
  };
  const int root_a = root_of(s.body), root_b = root_of(t.body);
  if (root_a == root_b) return true;
  if (!is_moved_by_forces(model, root_a) && !is_moved_by_forces(model, root_b)) return true;
  const auto rule = pairs.find(std::minmax(a, b));
  if (rule != pairs.end() && rule->second.collide) return !*rule->second.collide;
  if (s.group != 0 && s.group == t.group) return true;
  if (s.robot >= 0 && s.robot == t.robot &&
      (parent_of(root_a) == root_b || parent_of(root_b) == root_a))
    return true;
  return joined.contains(std::minmax(root_a, root_b));
}

bool SceneModel::may_touch() const {
  const int n = static_cast<int>(geometries.size());
  const auto moves = [&](int g) {
    const int body = geometries[static_cast<std::size_t>(g)].body;
    return is_moved_by_forces(model, roots[static_cast<std::size_t>(body)]);
  };
  for (int a = 0; a < n; ++a)
    for (int b = moves(a) ? 0 : n; b < n; ++b)
      if ((b > a || !moves(b)) && !is_apart(a, b)) return true;
  return false;
}

ContactSurface SceneModel::surface_of_pair(int a, int b) const {
  ContactSurface pair =
      combined(geometries[static_cast<std::size_t>(a)], geometries[static_cast<std::size_t>(b)]);
  const auto rule = pairs.find(std::minmax(a, b));
  if (rule == pairs.end()) return pair;
  pair.friction = rule->second.friction.value_or(pair.friction);
  pair.restitution = rule->second.restitution.value_or(pair.restitution);
  pair.stiffness = rule->second.stiffness.value_or(pair.stiffness);
  pair.dissipation = rule->second.dissipation.value_or(pair.dissipation);
  return pair;
}

}  // namespace twinarm
