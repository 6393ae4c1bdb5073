// Which pairs of boxes along the axes overlap.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "collision/detection/mesh_contact.h"
#include "collision/narrow_phase/gjk.h"
#include "collision/narrow_phase/narrow_phase.h"
#include "collision/shapes/shape.h"
#include "solver/spatial/pose.h"

namespace twinarm {

class BroadPhase {
 public:
  BroadPhase();
  ~BroadPhase();
  BroadPhase(BroadPhase&&) noexcept;
  BroadPhase& operator=(BroadPhase&&) noexcept;

  // One more box; returns its index. Call overlaps() with a box for each.
  int add();
  // All overlapping pairs (i < j), in an order that depends on the shape of the tree: sort them.
  void overlaps(std::span<const Aabb> boxes, std::vector<std::pair<int, int>>& pairs);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// All collision geometries of a scene: poses in, contacts out. Nothing else needs to know FCL.
//
//   CollisionWorld world;
//   const int ground = world.add({"ground", HalfSpace{}, 0});
//   const int hand = world.add({"hand", Box{{0.1, 0.1, 0.2}}, 1});
//   world.detect(X_WG, 1e-3, contacts);      // X_WG[ground], X_WG[hand]
//
// One instance per thread.
struct Geometry {
  std::string name;  // for messages
  Shape shape;
  int group = 0;          // 0 to 31
  bool is_fixed = false;  // never moves: two fixed ones do not collide
};

struct Contact {
  int a, b;      // geometry ids, a < b
  Vector3 p_WC;  // midway between the two surfaces [m]
  Vector3 n_W;   // unit, from a to b: pushes b away
  double depth;  // > 0 penetrating, < 0 still apart (speculative) [m]
  int feature;   // identity that persists from step to step, within its pair
};

class CollisionWorld {
 public:
  static constexpr int group_count = 32;
  CollisionWorld() { mask_.fill(~std::uint32_t{0}); }

  // Returns the id: 0, 1, 2 ... Throws InputError for a bad shape or group, and for a pair that can
  // not be treated (two half-spaces) unless the filter keeps the two apart already.
  int add(Geometry geometry);
  const Geometry& geometry(int id) const { return geometries_[static_cast<std::size_t>(id)]; }
  int size() const { return static_cast<int>(geometries_.size()); }

  // Never collide a with b: neighbours in a mechanism, say.
  void disable_pair(int a, int b);
  // Whether geometries of the two groups (which may be the same) collide. All do at first.
  void set_group_filter(int group_a, int group_b, bool collide);
  bool may_collide(int a, int b) const;

  // Contacts with depth > -(margin_a + margin_b) at the poses X_WG[id], ordered by (a, b, feature):
  // a function of the poses alone. A geometry whose pose is not finite has none. The margin of a
  // geometry is how far its points may move before the next detection: so nothing fast goes
  // through a wall between two of them.
  void detect(std::span<const Pose> X_WG, std::span<const double> margins,
              std::vector<Contact>& out);
  // Contacts with depth > -margin.
  void detect(std::span<const Pose> X_WG, double margin, std::vector<Contact>& out);

  // Signed distance of two geometries, filtered or not: positive apart, negative minus the least
  // overlap [m].
  double distance(int a, int b, const Pose& X_WA, const Pose& X_WB);

 private:
  void check_pair(int a, int b) const;
  void find_pairs(std::span<const Pose> X_WG, std::span<const double> margins);
  NarrowPhase::Result narrow(const PosedShape& a, const PosedShape& b, double margin);
  void collide_pair(int a, int b, std::span<const Pose> X_WG, double margin,
                    std::vector<Contact>& out);

  std::vector<Geometry> geometries_;
  std::vector<PreparedShape> solids_;
  std::array<std::uint32_t, group_count> mask_;      // bit j of mask i: groups i and j collide
  std::vector<std::pair<int, int>> disabled_pairs_;  // sorted
  std::vector<double> margins_;                      // one number spread over all
  BroadPhase broad_phase_;
  NarrowPhase narrow_phase_;
  MeshContact mesh_contact_;
  std::vector<int> bounded_, half_spaces_;  // ids with and without a bounding box
  std::vector<Aabb> boxes_;                 // of bounded_
  std::vector<std::pair<int, int>> pairs_;
  std::vector<ManifoldPoint> points_;
};

}  // namespace twinarm
