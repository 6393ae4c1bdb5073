// Forward kinematics of the last few states: energy and momentum balance look at the same ones.
#pragma once

#include <algorithm>
#include <array>

#include "solver/dynamics/kinematics.h"
#include "solver/model/model.h"

namespace twinarm {

class PosedStates {
 public:
  explicit PosedStates(const Model<double>& model)
      : model_(model), posed_{Posed(model), Posed(model), Posed(model), Posed(model)} {}

  // Valid until three other states have been asked for.
  const Kinematics& at(const State<double>& x) {
    const auto found = std::find_if(posed_.begin(), posed_.end(),
                                    [&](const Posed& p) { return p.used > 0 && is_same(p.x, x); });
    Posed& posed =
        found != posed_.end()
            ? *found
            : *std::min_element(posed_.begin(), posed_.end(),
                                [](const Posed& a, const Posed& b) { return a.used < b.used; });
    if (found == posed_.end()) {
      posed.x = x;
      forward_kinematics(model_, x, posed.k);
    }
    posed.used = ++count_;
    return posed.k;
  }

 private:
  struct Posed {
    explicit Posed(const Model<double>& model) : k(model) {}
    State<double> x;
    Kinematics k;
    long used = 0;  // 0: never
  };
  static bool is_same(const State<double>& a, const State<double>& b) {
    return a.q == b.q && a.qd == b.qd && a.prescribed == b.prescribed && a.t == b.t;
  }

  const Model<double>& model_;
  std::array<Posed, 4> posed_;
  long count_ = 0;
};

}  // namespace twinarm
