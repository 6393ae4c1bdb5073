// What touches what, and with which surface.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "app/scene/model/scene_builder.h"
#include "collision/contact/contact_constraints.h"
#include "collision/geometry/convex_hull.h"
#include "collision/import/robot/robot_model.h"

namespace twinarm {
namespace {

// The first body inward that moves on a joint of its own, or the world: bodies of one piece do not
// move against one another.
int piece_of(const Model<double>& model, int body) {
  while (body > 0 && model.joint[static_cast<std::size_t>(body)] == JointType::fixed)
    body = model.parent[static_cast<std::size_t>(body)];
  return body;
}

bool is_moved_by_forces(const Model<double>& model, int piece) {
  return piece > 0 && model.joint[static_cast<std::size_t>(piece)] != JointType::prescribed;
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
    find_pairs_apart();
    for (const PairDescription& pair : description().pairs)
      scene_.pairs.push_back({meant(pair.a), meant(pair.b), pair.friction, pair.restitution,
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

  std::vector<int> meant(const std::string& name) const {
    const SceneReference wanted = *find_reference(description(), name);
    std::vector<int> found;
    for (std::size_t g = 0; g < owners_.size(); ++g)
      if (owners_[g].body == wanted.body && owners_[g].robot == wanted.robot &&
          (wanted.link.empty() || owners_[g].link == wanted.link))
        found.push_back(static_cast<int>(g));
    return found;
  }

  // The last rule that says something about it counts; else what keeps bodies apart by itself.
  bool is_apart(int a, int b) const {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    const Model<double>& model = scene_.model;
    const int piece_a = piece_of(model, scene_.geometries[i].body);
    const int piece_b = piece_of(model, scene_.geometries[j].body);
    if (piece_a == piece_b) return true;
    if (!is_moved_by_forces(model, piece_a) && !is_moved_by_forces(model, piece_b)) return true;
    if (told_[i].size() > j && told_[i][j] != 0) return told_[i][j] < 0;
    const int group = scene_.geometries[i].group;
    if (group != 0 && group == scene_.geometries[j].group) return true;
    if (owners_[i].robot >= 0 && owners_[i].robot == owners_[j].robot &&
        (inward(piece_a) == piece_b || inward(piece_b) == piece_a))
      return true;
    return std::any_of(
        scene_.constraints.begin(), scene_.constraints.end(), [&](const SceneConstraint& c) {
          const bool joins = c.type == SceneConstraint::Type::weld ||
                             c.type == SceneConstraint::Type::ball ||
                             c.type == SceneConstraint::Type::hinge;
          const int on_a = piece_of(model, c.a), on_b = piece_of(model, c.b);
          return joins &&
                 ((on_a == piece_a && on_b == piece_b) || (on_a == piece_b && on_b == piece_a));
        });
  }
  int inward(int piece) const {
    return piece == 0
               ? 0
               : piece_of(scene_.model, scene_.model.parent[static_cast<std::size_t>(piece)]);
  }

  void find_pairs_apart() {
    const std::size_t n = scene_.geometries.size();
    told_.assign(n, {});
    for (const PairDescription& pair : description().pairs) {
      if (!pair.collide) continue;
      for (const int a : meant(pair.a))
        for (const int b : meant(pair.b)) {
          auto& row = told_[static_cast<std::size_t>(std::min(a, b))];
          row.resize(n, 0);
          row[static_cast<std::size_t>(std::max(a, b))] = *pair.collide ? 1 : -1;
        }
    }
    for (int a = 0; a < static_cast<int>(n); ++a)
      for (int b = a + 1; b < static_cast<int>(n); ++b)
        if (is_apart(a, b)) scene_.apart.emplace_back(a, b);
  }

  SceneModel& scene_;
  std::vector<SceneReference> owners_;          // by geometry
  std::vector<std::vector<signed char>> told_;  // [a][b], a < b: 1 they touch, -1 they do not
};

bool holds(const std::vector<int>& sorted, int value) {
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
  for (const PairOverride& problem : pairs) {
    if (!(holds(problem.a, a) && holds(problem.b, b)) &&
        !(holds(problem.a, b) && holds(problem.b, a)))
      continue;
    pair.friction = problem.friction.value_or(pair.friction);
    pair.restitution = problem.restitution.value_or(pair.restitution);
    pair.stiffness = problem.stiffness.value_or(pair.stiffness);
    pair.dissipation = problem.dissipation.value_or(pair.dissipation);
  }
  return pair;
}

Shape collision_shape(const ShapeDescription& shape) {
  return std::visit(
      [](const auto& known) -> Shape {
        if constexpr (!std::is_same_v<decltype(known), const MeshGeometry&>) {
          return known;
        } else {
          TriangleMesh mesh = load_mesh(known);
          if (known.convex) return convex_hull(mesh.vertices);
          return MeshShape{std::move(mesh)};
        }
      },
      shape);
}

}  // namespace twinarm
