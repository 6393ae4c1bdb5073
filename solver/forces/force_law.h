// A force source from a function of state, kinematics and forces; it has no internal state.
#pragma once

#include <functional>
#include <utility>

#include "solver/forces/force_source.h"
#include "solver/support/checkpointable.h"

namespace twinarm {

class ForceLaw final : public ForceSource, public Checkpointable {
 public:
  using Law = std::function<void(const State<double>&, const Kinematics&, Forces<double>&)>;
  explicit ForceLaw(Law law) : law_(std::move(law)) {}
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    law_(x, k, forces);
  }

 private:
  Law law_;
};

}  // namespace twinarm
