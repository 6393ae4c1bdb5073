// The public class of collision detection.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "collision/detection/fcl_box_tree.h"
#include "collision/detection/fcl_contact.h"
#include "collision/detection/mesh_contact.h"
#include "collision/narrow_phase/gjk.h"
#include "collision/narrow_phase/narrow_phase.h"
#include "collision/shapes/shape.h"
#include "solver/spatial/pose.h"

namespace twinarm {

// All collision geometries of a scene: poses in, contacts out.
//
//   CollisionWorld world;
//   const int ground = world.add({"ground", HalfSpace{}, 0});
//   const int tool = world.add({"tool", Box{{0.1, 0.1, 0.2}}, 1});
//   world.detect(X_WG, 1e-3, contacts);      // X_WG[ground], X_WG[tool]
//
// One instance per thread.
struct Geometry {
  std::string name;
  Shape shape;
  int group = 0;  // geometries of one group other than 0 do not collide
  int body = -1;  // geometries of one body do not collide; -1: a body of its own
};

struct Contact {
  int a, b;      // geometry ids, a < b
  Vector3 p_WC;  // midway between the two surfaces [m]
  Vector3 n_W;   // unit, from a to b
  double depth;  // penetration depth; < 0: gap (speculative contact) [m]
  int feature;   // identity within the pair, persistent from step to step
};

class CollisionWorld {
 public:
  // Returns the id: 0, 1, 2 ... Throws InputError for an invalid shape, and for an unsupported
  // pair (two half-spaces) that is not filtered out.
  int add(Geometry geometry);
  const Geometry& geometry(int id) const { return geometries_[static_cast<std::size_t>(id)]; }
  int size() const { return static_cast<int>(geometries_.size()); }

  // Excludes collision pairs a < b, e.g. neighbours in a mechanism.
  void set_pair_filter(std::function<bool(int a, int b)> is_excluded) {
    is_excluded_ = std::move(is_excluded);
  }
  bool may_collide(int a, int b) const;

  // Normals by FCL where it has an algorithm (fcl_contact.h), from now on. detect() then allocates.
  void use_fcl();
  struct FclUse {
    std::size_t queries = 0;   // of pairs that FCL can answer
    std::size_t rejected = 0;  // answers that were inconsistent: our own narrow phase answered
  };
  const FclUse& fcl_use() const { return fcl_use_; }

  // Contacts with depth > -(margin_a + margin_b) at the poses X_WG[id], ordered by (a, b, feature);
  // a function of the poses only. None for a geometry whose pose is not finite. With margins as
  // large as the displacement until the next detection nothing passes through a wall.
  void detect(std::span<const Pose> X_WG, std::span<const double> margins,
              std::vector<Contact>& out);
  // Contacts with depth > -margin.
  void detect(std::span<const Pose> X_WG, double margin, std::vector<Contact>& out);

  // Signed distance of two geometries, filtered or not; negative: penetration depth [m].
  double distance(int a, int b, const Pose& X_WA, const Pose& X_WB);

 private:
  void check_pair(int a, int b) const;
  void find_moved(std::span<const Pose> X_WG, std::span<const double> margins);
  void find_overlaps();
  void find_pairs(std::span<const Pose> X_WG, std::span<const double> margins);
  NarrowPhase::Result narrow(const PosedShape& a, const PosedShape& b, double margin);
  NarrowPhase::Result narrow_by_fcl(int a, int b, std::span<const Pose> X_WG, double margin);
  void collide_pair(int a, int b, std::span<const Pose> X_WG, double margin,
                    std::vector<Contact>& out);

  std::vector<Geometry> geometries_;
  std::vector<PreparedShape> solids_;
  std::function<bool(int, int)> is_excluded_;
  std::vector<double> margins_;    // of detect() with one margin
  std::unique_ptr<BoxTree> tree_;  // of many boxes; null until it is needed
  NarrowPhase narrow_phase_;
  std::unique_ptr<FclContact> fcl_;  // null unless it is used
  FclUse fcl_use_;
  MeshContact mesh_contact_;
  std::vector<int> bounded_, half_spaces_;  // ids with and without a bounding box
  std::vector<Aabb> boxes_;                 // of bounded_
  std::vector<std::pair<int, int>> pairs_;
  // Contacts of pairs at the poses and margins of the last detection are kept.
  struct Detected {
    std::vector<Pose> X_WG;
    std::vector<double> margins;
    std::vector<std::pair<int, int>> pairs;
    std::vector<Contact> contacts;
  } last_;
  std::vector<char> moved_;  // by geometry: since the last detection
  std::vector<ManifoldPoint> points_;
};

}  // namespace twinarm
