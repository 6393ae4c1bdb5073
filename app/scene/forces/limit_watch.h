// A warning for joints that pass position limits which do not act.
#pragma once

#include <string>
#include <vector>

#include "app/robot/robot_input.h"

namespace twinarm {

// Notes the first time at which a joint stands beyond its limits, which do not act.
class LimitWatch {
 public:
  LimitWatch(const RobotInput& input, bool limits_act, std::vector<std::string>& warnings)
      : warnings_(warnings) {
    if (limits_act) return;
    for (const JointDescription& joint : input.robot.joints) {
      const int body = input.model.find_joint(joint.name);
      if (joint.is_limited() && body > 0)
        limits_.push_back({&joint, input.model.iq[static_cast<std::size_t>(body)]});
    }
  }
  void look(double t, const State<double>& x);

 private:
  struct Limit {
    const JointDescription* joint;
    std::size_t iq;
    bool is_told = false;
  };
  std::vector<Limit> limits_;
  std::vector<std::string>& warnings_;
};

}  // namespace twinarm
