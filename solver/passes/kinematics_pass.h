// Forward kinematics, RBDA section 4.1 and 3.4: where the bodies are and how fast they move.
//
//   Xup_i = XJ Xtree,   X0_i = Xup_i X0_p,   v_i = Xup_i v_p + S qd
//
// Writes Xup, v, c, S_, and X0 where w is a Workspace and not BodyVelocities alone. Callers include
// solver/dynamics/dynamics.h and kinematics.cpp.
#pragma once

#include "solver/model/joint_slice.h"
#include "solver/model/workspace.h"
#include "solver/spatial/instruction_set.h"

namespace twinarm::TWINARM_ISA {

template <class S, class W>
[[gnu::flatten]] void kinematics(const Model<S>& model, const State<S>& x, W& w) {
  constexpr bool has_X0 = requires {
    w.X0;
  };
  forget(w.v), forget(w.c);
  w.v[0] = {};
  if constexpr (has_X0) forget(w.X0), w.X0[0] = {};
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    visit_joint(model, i, [&](auto joint) TWINARM_KERNEL {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const S *q = x.q.data() + model.iq[i], *qd = x.rates(joint, model, i);
      const auto S_i = joint.subspace(q);
      const auto vJ = joint_velocity(joint, S_i, qd);
      w.Xup[i] = joint.XJ(q) * model.Xtree[i];
      if constexpr (has_X0) w.X0[i] = w.Xup[i] * w.X0[p];
      w.v[i] = w.Xup[i] * w.v[p] + vJ;
      w.c[i] = crm(w.v[i], vJ) + joint.cJ(q, qd);
      remember(S_i, w.S_.data() + model.iv[i]);
    });
  }
}

}  // namespace twinarm::TWINARM_ISA
