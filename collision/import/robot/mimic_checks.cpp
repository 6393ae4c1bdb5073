// A joint that follows another one: both have one coordinate, and who leads does not follow in turn
// the one that it leads.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "collision/import/robot/robot_validation.h"

namespace twinarm {
namespace {

constexpr const char* kOneCoordinate =
    "only joints of one coordinate follow and lead: revolute, continuous, prismatic, screw";

class MimicRules {
 public:
  explicit MimicRules(RuleBook& book) : book_(book), leader_(book.robot.joints.size(), kNone) {}

  void run() {
    const auto& joints = book_.robot.joints;
    std::map<std::string, std::size_t> index;
    for (std::size_t j = 0; j < joints.size(); ++j) index.emplace(joints[j].name, j);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (!joints[j].mimic) continue;
      const auto found = index.find(joints[j].mimic->joint);
      pair(j, found == index.end() ? kNone : found->second);
    }
    loops();
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  void fault(std::size_t follower, const std::string& rule, const std::string& remedy,
             std::string_view code) {
    const JointDescription& joint = book_.robot.joints[follower];
    book_.fault(line_of(joint.lines.mimic, joint.line), of(joint), rule, remedy, code);
  }

  void pair(std::size_t follower, std::size_t leader) {
    const JointDescription& joint = book_.robot.joints[follower];
    if (!std::isfinite(joint.mimic->multiplier) || !std::isfinite(joint.mimic->offset))
      fault(follower, "its mimic has a number that is not finite", "give finite numbers",
            "robot.not-finite");
    if (leader == kNone)
      return fault(follower, "it mimics joint '" + joint.mimic->joint + "', which does not exist",
                   "name a joint of this robot", "robot.mimic-unknown");
    if (leader == follower)
      return fault(follower, "it mimics itself", "name the joint that it follows",
                   "robot.mimic-itself");
    const JointDescription& other = book_.robot.joints[leader];
    for (const JointDescription* j : {&joint, &other})
      if (j->dofs() != 1)
        return fault(follower,
                     "it mimics " + of(other) + ", but " + of(*j) + " (" + to_string(j->type) +
                         ") has " + std::to_string(j->dofs()) + " coordinates",
                     kOneCoordinate, "robot.mimic-coordinates");
    if (joint.mimic->multiplier == 0)
      book_.warn(line_of(joint.lines.mimic, joint.line), of(joint),
                 "its mimic has multiplier 0: it stands still at the offset",
                 "make it a fixed joint");
    leader_[follower] = leader;
  }

  // Each loop is told once, at that joint of it that stands first in the file. O(n): a walk stops
  // where an earlier one has been.
  void loops() {
    std::vector<std::size_t> walk(leader_.size(), kNone);  // which walk came by
    for (std::size_t start = 0; start < leader_.size(); ++start) {
      std::size_t j = start;
      while (j != kNone && walk[j] == kNone) {
        walk[j] = start;
        j = leader_[j];
      }
      if (j == kNone || walk[j] != start) continue;
      std::size_t first = j;
      std::string text = book_.robot.joints[j].name;
      for (std::size_t k = leader_[j];; k = leader_[k]) {
        text += " -> " + book_.robot.joints[k].name;
        first = std::min(first, k);
        if (k == j) break;
      }
      fault(first, "joints mimic each other in a loop: " + text, "let one of them lead",
            "robot.mimic-loop");
    }
  }

  RuleBook& book_;
  std::vector<std::size_t> leader_;
};

}  // namespace

void check_mimics(RuleBook& book) {
  MimicRules(book).run();
}

}  // namespace twinarm
