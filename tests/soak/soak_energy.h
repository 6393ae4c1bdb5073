// Does a step create energy? Books that are kept from outside, with kinematics and inverse
// dynamics.
//
// A step from (q, v) to (q', v') under forces Q and impulses p of contacts is
//   M(q) (v+ - v)  = J^T p                                impacts
//   M(q) (v' - v+) = h (Q - b) + J^T p,                   b = C(q, v+) v+ + G
//   q' = q + h v', and what penetrates is moved apart.
// So, T the kinetic energy,
//   T(q, v+) - T(q, v)                                    of impacts
//   T(q, v') - T(q, v+) - h (Q - b) . v'                  of contacts, limits and friction
//     = p . u' - |v' - v+|^2_M / 2
// are not above 0: nothing of that kind gives any. That is exact in every step, and `created` is
// the larger of the two. Q are shoves, and couplings as they pull at the end of the step (pull less
// m* dv/h). Of free bodies C v is the gyroscopic moment m x I m of the mean m of w+ and of the w
// that the step would end with but for p; it is found here by iteration.
//
// Of free bodies all the rest of E' - E, E = T + V, is known too: W, the work of the shoves;
// `apart`, of what is moved apart, a penetration deep; and what the gyroscopic moment does because
// w' is not m,
//   turning = -h sum (m x I m) . w',
// of which in flight |v' - v+|^2_M / 2 takes all. `given` = E' - E - W - apart - turning is not
// above 0. (A body that flies moves by the mean of its velocities: likewise.)
//
// `excess` is E - E(0) - W of the whole run, with k e^2/2 of the springs in E, and the work of the
// couplings' hands in W: where there are robots, it has what the integrator does to them between q
// and q', which is of first order in h and of either sign.
#pragma once

#include <vector>

#include "app/scene/forces/scene_couplings.h"
#include "solver/model/workspace.h"
#include "tests/soak/soak_shoves.h"

namespace twinarm::soak {

class EnergyBooks {
 public:
  EnergyBooks(const SceneModel& scene, SceneCouplings& couplings, Shoves& shoves);
  void begin(const State<double>& x);
  // After a step of h from the state of the last call. v_struck: v+; apart: of that step [J].
  void add_step(const State<double>& x, const std::vector<double>& v_struck, double apart,
                double h);

  double created() const { return created_; }  // by the last step [J]
  double given() const { return given_; }      // likewise; of free bodies alone
  // Of the whole run [J].
  double apart() const { return apart_; }
  double excess() const { return energy_ - start_ - work_; }
  // What the energies are measured by: kinetic energy, and the work that was done [J].
  double scale() const { return scale_ + gone_; }
  double work() const { return work_; }

 private:
  double elastic(const State<double>& x);
  double kinetic(const State<double>& x);
  struct Turning {
    double work = 0, more = 0;  // of m x I m, and by how much w+ x I w+ would do less [J]
  };
  Turning turned(const State<double>& to, double h);

  const SceneModel& scene_;
  SceneCouplings& couplings_;
  Shoves& shoves_;
  Kinematics k_, k_end_;
  Workspace<double> w_;
  std::vector<double> still_;
  std::vector<Force<double>> no_forces_;
  Forces<double> pushed_;
  State<double> x_, between_;
  double start_ = 0, energy_ = 0, kinetic_ = 0, potential_ = 0, work_ = 0, gone_ = 0, scale_ = 0,
         created_ = 0, given_ = 0, apart_ = 0;
};

}  // namespace twinarm::soak
