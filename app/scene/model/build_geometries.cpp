// Geometries, their surfaces, and the pairs without contacts.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "app/scene/model/scene_builder.h"
#include "collision/contact/contact_constraints.h"
#include "collision/geometry/convex_hull.h"
#include "collision/import/robot/robot_model.h"

namespace twinarm {
namespace {

// The nearest ancestor (or the body itself) whose joint is not fixed, or the world: the root of the
// rigid body that it belongs to.
int rigid_root_of(const Model<double>& model, int body) {
  while (body > 0 && model.joint[static_cast<std::size_t>(body)] == JointType::fixed)
    body = model.parent[static_cast<std::size_t>(body)];
  return body;
}

bool is_moved_by_forces(const Model<double>& model, int root) {
  return root > 0 && model.joint[static_cast<std::size_t>(root)] != JointType::prescribed;
}

class GeometryBuilder {
 public:
  explicit GeometryBuilder(SceneModel& scene) : scene_(scene) {}

  void build() {
    for (std::size_t r = 0; r < description().robots.size(); ++r) add_robot(r);
    for (std::size_t b = 0; b < description().bodies.size(); ++b) {
      const BodyDescription& body = description().bodies[b];
      const int index = body_of(scene_, {static_cast<int>(b), -1, ""});
      add({body.surface, body.name, index, index == 0 ? body.X_WB : Pose{}, body.shape, body.group},
          {static_cast<int>(b), -1, ""});
    }
    constexpr std::size_t kMaxGeometries = 10000;  // all pairs are looked at
    if (scene_.geometries.size() > kMaxGeometries)
      throw InputError(
          {{description().file.string(), 0, "", "there are more than 10,000 shapes that may touch",
            "give fewer bodies, or robots with collide = false", "scene.too-many"}});
    find_pairs_apart();
    for (const PairDescription& pair : description().pairs)
      scene_.pairs.push_back({named(pair.a), named(pair.b), pair.friction, pair.restitution,
                              pair.stiffness, pair.dissipation});
  }

 private:
  const SceneDescription& description() const { return scene_.description; }

  void add_robot(std::size_t r) {
    const RobotInScene& robot = description().robots[r];
    if (!robot.collide) return;
    for (const LinkDescription& link : robot.description.links)
      for (const CollisionPart& part : link.collisions) {
        const SceneReference owner{-1, static_cast<int>(r), link.name};
        SceneGeometry geometry{robot.surface,          name_in_scene(description(), r, link.name),
                               body_of(scene_, owner), part.X_LG(),
                               part.geometry,          0};
        add(std::move(geometry), owner);
      }
  }

  void add(SceneGeometry geometry, SceneReference owner) {
    scene_.geometries.push_back(std::move(geometry));
    owners_.push_back(std::move(owner));
  }

  std::vector<int> named(const std::string& name) const {
    const SceneReference wanted = *find_reference(description(), name);
    std::vector<int> found;
    for (std::size_t g = 0; g < owners_.size(); ++g)
      if (owners_[g].body == wanted.body && owners_[g].robot == wanted.robot &&
          (wanted.link.empty() || owners_[g].link == wanted.link))
        found.push_back(static_cast<int>(g));
    return found;
  }

  // The last matching [[pair]] decides; then the default rules.
  bool is_apart(int a, int b) const {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const Model<double>& model = scene_.model;
    const int root_a = roots_[i], root_b = roots_[j];
    if (root_a == root_b) return true;
    if (!is_moved_by_forces(model, root_a) && !is_moved_by_forces(model, root_b)) return true;
    if (rules_[i].size() > j && rules_[i][j] != 0) return rules_[i][j] < 0;
    const int group = scene_.geometries[i].group;
    if (group != 0 && group == scene_.geometries[j].group) return true;
    if (owners_[i].robot >= 0 && owners_[i].robot == owners_[j].robot &&
        (parent_of(root_a) == root_b || parent_of(root_b) == root_a))
      return true;
    return joined_.contains(std::minmax(root_a, root_b));
  }
  int parent_of(int root) const {
    if (root == 0) return 0;
    return rigid_root_of(scene_.model, scene_.model.parent[static_cast<std::size_t>(root)]);
  }

  void find_pairs_apart() {
    const std::size_t n = scene_.geometries.size();
    for (const SceneGeometry& geometry : scene_.geometries)
      roots_.push_back(rigid_root_of(scene_.model, geometry.body));
    for (const SceneConstraint& c : scene_.constraints) {
      using Type = SceneConstraint::Type;
      if (c.type == Type::weld || c.type == Type::ball || c.type == Type::hinge)
        joined_.insert(
            std::minmax(rigid_root_of(scene_.model, c.a), rigid_root_of(scene_.model, c.b)));
    }
    rules_.assign(n, {});
    for (const PairDescription& pair : description().pairs) {
      if (!pair.collide) continue;
      for (const int a : named(pair.a))
        for (const int b : named(pair.b)) {
          auto& row = rules_[static_cast<std::size_t>(std::min(a, b))];
          row.resize(n, 0);
          row[static_cast<std::size_t>(std::max(a, b))] = *pair.collide ? 1 : -1;
        }
    }
    for (int a = 0; a < static_cast<int>(n); ++a)
      for (int b = a + 1; b < static_cast<int>(n); ++b)
        if (is_apart(a, b)) scene_.apart.emplace_back(a, b);
  }

  SceneModel& scene_;
  std::vector<SceneReference> owners_;           // by geometry
  std::vector<int> roots_;                       // rigid_root_of its body
  std::set<std::pair<int, int>> joined_;         // roots joined by constraints, ascending
  std::vector<std::vector<signed char>> rules_;  // [a][b], a < b: 1 contacts, -1 none, 0 default
};

bool contains(const std::vector<int>& sorted, int value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

}  // namespace

void build_geometries(SceneModel& scene) {
  GeometryBuilder(scene).build();
}

bool SceneModel::may_touch() const {
  const std::size_t n = geometries.size();
  return apart.size() < n * (n - (n > 0 ? 1 : 0)) / 2;
}

Surface SceneModel::surface_of_pair(int a, int b) const {
  const Surface &s = geometries[static_cast<std::size_t>(a)],
                &t = geometries[static_cast<std::size_t>(b)];
  const Compliance soft = in_series({s.stiffness, s.dissipation}, {t.stiffness, t.dissipation});
  Surface pair{std::sqrt(s.friction * t.friction),
               s.restitution * t.restitution,
               std::max(s.torsional_friction, t.torsional_friction),
               std::max(s.rolling_friction, t.rolling_friction),
               soft.stiffness,
               soft.dissipation};
  for (const PairOverride& rule : pairs) {
    if (!(contains(rule.a, a) && contains(rule.b, b)) &&
        !(contains(rule.a, b) && contains(rule.b, a)))
      continue;
    pair.friction = rule.friction.value_or(pair.friction);
    pair.restitution = rule.restitution.value_or(pair.restitution);
    pair.stiffness = rule.stiffness.value_or(pair.stiffness);
    pair.dissipation = rule.dissipation.value_or(pair.dissipation);
  }
  return pair;
}

}  // namespace twinarm
