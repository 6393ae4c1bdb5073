// An operator motion that another one can replace at times.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "coupling/target/operator_motion.h"

namespace twinarm {

class OverridableMotion final : public OperatorMotion {
 public:
  // Null: not replaced at that time.
  using Substitute = std::function<const OperatorMotion*(double t, double toward)>;
  OverridableMotion(std::unique_ptr<OperatorMotion> own, Substitute substitute)
      : own_(std::move(own)), substitute_(std::move(substitute)) {}
  OperatorSample sample(double t, double toward) const override {
    const OperatorMotion* other = substitute_(t, toward);
    return (other ? *other : *own_).sample(t, toward);
  }
  double duration() const override { return own_->duration(); }
  std::string description() const override { return own_->description(); }

 private:
  std::unique_ptr<OperatorMotion> own_;
  Substitute substitute_;
};

}  // namespace twinarm
