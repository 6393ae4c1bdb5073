// The direction of least overlap where one of two bodies is a cylinder or an ellipsoid.
#pragma once

#include <vector>

#include "collision/narrow_phase/closed_forms.h"
#include "collision/narrow_phase/gjk.h"
#include "collision/narrow_phase/sphere_minimization.h"

namespace twinarm {

// Keeps its arrays from call to call, so that a step does not allocate.
class CurvedAxis {
 public:
  // False if it is certain that the bodies are more than `margin` apart.
  bool nearest(const PosedShape& a, const PosedShape& b, double margin, NearestPair& pair);

 private:
  struct Posed {  // patches in W, from the origin of A, that may carry the optimum
    std::vector<Patches::Ridge> ridges;
    std::vector<Vector3> along;  // of each ridge, unit
    std::vector<Patches::Round> rounds;
  };
  void place(const PosedShape& body, const PosedShape& other, double reach, Posed& posed);
  void offer(const Vector3& n_W, double handicap);
  void offer_round(const Vector3& n_W, const Patches::Round& round, bool is_of_a);
  double limit() const;
  void try_flats();
  void try_seeds();
  void try_patches(double reach);
  void try_ridges();
  void try_rounds_on_ridges(const Posed& rounds, const Posed& ridges, bool rounds_are_a);
  void try_rounds();
  void search_sphere(const SupportSum& f, const Patches::Round& round, bool is_of_a);

  const PosedShape* body_a_ = nullptr;
  const PosedShape* body_b_ = nullptr;
  Vector3 origin_;
  bool overlaps_ = false, is_deep_ = false;
  NearestPair seed_, best_;
  Posed a_, b_;
  std::vector<Vector3> found_, corners_;
  std::vector<double> bounds_;  // by flat
};

}  // namespace twinarm
