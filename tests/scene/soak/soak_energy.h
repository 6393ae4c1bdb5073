// Does a step create energy? Two books, kept from outside with kinematics and inverse dynamics.
//
// A step from (q, v) to (q', v') under forces Q and impulses p of contacts is
//   M(q) (v' - v) = h (Q - b(q, v)) + J^T p,      b = C v + G,
// so  T(q, v') - T(q, v) - h (Q - b) . v' = p . u' - |v' - v|^2_M / 2 <= 0 :
// contacts, limits and friction give nothing, and the rest is lost. That is exact in every step,
// and `created` is the largest of its left side. Q are shoves, and couplings as they pull at the
// end of the step (pull less m* dv/h).
//
// `excess` is E - E(0) - W of the whole run, E = T + V + k e^2/2 and W the work of shoves and of
// the couplings' hands: it has what the integrator does between q and q' besides, which is of first
// order in h and of either sign, and the separation of what penetrates.
#pragma once

#include <vector>

#include "app/scene/scene_couplings.h"
#include "solver/workspace.h"
#include "tests/scene/soak/soak_shoves.h"

namespace twinarm::soak {

class EnergyBooks {
 public:
  EnergyBooks(const SceneModel& scene, SceneCouplings& couplings, const Shoves& shoves);
  void begin(const State<double>& x);
  // After a step of h from the state of the last call.
  void add_step(const State<double>& x, double h);

  double created() const { return created_; }  // by the last step [J]
  double excess() const { return energy_ - start_ - work_; }
  // What the energies are measured by: kinetic energy, and the work that was done [J].
  double scale() const { return scale_ + gone_; }
  double work() const { return work_; }

 private:
  double elastic(const State<double>& x);
  double kinetic(const State<double>& x);

  const SceneModel& scene_;
  SceneCouplings& couplings_;
  const Shoves& shoves_;
  Kinematics k_, k_end_;
  Workspace<double> w_;
  std::vector<double> still_;
  std::vector<Force<double>> no_forces_;
  State<double> x_, between_;
  double start_ = 0, energy_ = 0, kinetic_ = 0, potential_ = 0, work_ = 0, gone_ = 0, scale_ = 0,
         created_ = 0;
};

}  // namespace twinarm::soak
