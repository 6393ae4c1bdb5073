// Checks that links and joints form one tree and that chains of mimic joints have no loop. O(number
// of joints).
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "collision/import/robot/robot_check.h"

namespace twinarm {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

// By link: the joint to its parent (the first one in the file).
std::map<std::string, std::size_t> parent_joints(const RobotDescription& robot) {
  std::map<std::string, std::size_t> parent_joint;
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    parent_joint.emplace(robot.joints[j].child, j);
  return parent_joint;
}

// All cycles of the function i -> next[i], each once.
std::vector<std::vector<std::size_t>> loops_of(const std::vector<std::size_t>& next) {
  std::vector<std::vector<std::size_t>> loops;
  std::vector<std::size_t> walk(next.size(), kNone);  // index of the walk that visited the item
  for (std::size_t start = 0; start < next.size(); ++start) {
    std::size_t at = start;
    for (; at != kNone && walk[at] == kNone; at = next[at]) walk[at] = start;
    if (at == kNone || walk[at] != start) continue;
    loops.emplace_back(1, at);
    for (std::size_t i = next[at]; i != at; i = next[i]) loops.back().push_back(i);
  }
  return loops;
}

class TreeCheck {
 public:
  explicit TreeCheck(ValidationContext& context)
      : context_(context), robot_(context.robot), parent_joint_(parent_joints(context.robot)) {}

  void run() {
    const bool children_known = check_references();
    check_single_parents();
    const bool acyclic = check_loops();
    // With an unknown child link the count of roots is meaningless.
    if (children_known) check_one_root();
    if (acyclic && context_.faults.empty()) check_moving_masses();
  }

 private:
  bool check_references() {
    std::set<std::string> names;
    for (const LinkDescription& link : robot_.links) names.insert(link.name);
    const auto known = [&](const JointDescription& joint, const std::string& link, int line,
                           const std::string& role) {
      if (names.count(link)) return true;
      context_.fault(line_of(line, joint.line), of(joint),
                     "its " + role + " link " +
                         (link.empty() ? "is missing" : "'" + link + "' does not exist"),
                     "use the name of a link of this robot", "robot.link-unknown");
      return false;
    };
    bool children_known = true;
    for (const JointDescription& joint : robot_.joints) {
      known(joint, joint.parent, joint.lines.parent, "parent");
      children_known = known(joint, joint.child, joint.lines.child, "child") && children_known;
    }
    return children_known;
  }

  void check_single_parents() {
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      const JointDescription& joint = robot_.joints[j];
      const JointDescription& first = robot_.joints[parent_joint_.at(joint.child)];
      if (&first != &joint)
        context_.fault(joint.line, of(joint),
                       "its child link '" + joint.child + "' is also the child of " + of(first) +
                           " in line " + std::to_string(first.line),
                       "give each link one parent; close loops by a constraint",
                       "robot.two-parents");
    }
  }

  // Each loop is reported once, at its first joint in the file.
  bool check_loops() {
    std::vector<std::size_t> previous;  // by joint: the joint of its parent link
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      const JointDescription& joint = robot_.joints[j];
      const std::size_t first = parent_joint_.at(joint.child);
      const auto up = parent_joint_.find(joint.parent);
      previous.push_back(first != j ? first : up == parent_joint_.end() ? kNone : up->second);
    }
    const auto loops = loops_of(previous);
    for (const std::vector<std::size_t>& loop : loops) {
      const JointDescription* first = &robot_.joints[loop.front()];
      std::string text;
      for (auto j = loop.rbegin(); j != loop.rend(); ++j) {
        const JointDescription& joint = robot_.joints[*j];
        if (joint.line < first->line) first = &joint;
        text += joint.parent + " -> ";
      }
      context_.fault(first->line, of(*first),
                     "its links form a loop: " + text + robot_.joints[loop.front()].child,
                     "remove one joint, and close the loop by a constraint", "robot.loop");
    }
    return loops.empty();
  }

  void check_one_root() {
    const LinkDescription* first = nullptr;
    for (const LinkDescription& link : robot_.links) {
      if (parent_joint_.count(link.name) || link.name.empty()) continue;
      if (first && first->name != link.name)
        context_.fault(link.line, of(link),
                       "it has no parent, nor has '" + first->name + "' in line " +
                           std::to_string(first->line) + ": a robot has one root link",
                       "connect it to the tree, e.g. with a fixed joint", "robot.two-roots");
      if (!first) first = &link;
    }
  }

  // A warning only: masses can be added later. ModelBuilder rejects joints without inertia.
  void check_moving_masses() {
    std::set<std::string> massive;
    for (const LinkDescription& link : robot_.links)
      if (link.has_inertia && (link.mass > 0 || !link.inertia.isZero(0))) massive.insert(link.name);
    const std::vector<std::size_t> order = joints_from_root(robot_);
    for (auto j = order.rbegin(); j != order.rend(); ++j)
      if (massive.count(robot_.joints[*j].child)) massive.insert(robot_.joints[*j].parent);
    for (const JointDescription& joint : robot_.joints) {
      // An armature is inertia too; a mimic joint has no degree of freedom.
      const bool moves = joint.dofs() > 0 && joint.armature == 0 && !joint.mimic;
      if (moves && !massive.count(joint.child))
        context_.warn(
            joint.line, of(joint), "link '" + joint.child + "' and its descendants have no mass",
            "give mass and inertia for dynamics, or make the joint fixed", "robot.no-mass");
    }
  }

  ValidationContext& context_;
  const RobotDescription& robot_;
  const std::map<std::string, std::size_t> parent_joint_;
};

constexpr const char* kOneCoordinate =
    "mimic joints and mimicked joints must be revolute, continuous, prismatic or screw";

// A mimic joint and its mimicked joint have one coordinate each; chains have no loop.
class MimicCheck {
 public:
  explicit MimicCheck(ValidationContext& context)
      : context_(context), mimicked_(context.robot.joints.size(), kNone) {}

  void run() {
    const auto& joints = context_.robot.joints;
    std::map<std::string, std::size_t> index;
    for (std::size_t j = 0; j < joints.size(); ++j) index.emplace(joints[j].name, j);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (!joints[j].mimic) continue;
      const auto found = index.find(joints[j].mimic->joint);
      pair(j, found == index.end() ? kNone : found->second);
    }
    // Each loop is reported once, at its first joint in the file.
    for (const std::vector<std::size_t>& loop : loops_of(mimicked_)) {
      std::string text;
      for (const std::size_t j : loop) text += joints[j].name + " -> ";
      fault(*std::min_element(loop.begin(), loop.end()),
            "mimic loop: " + text + joints[loop.front()].name, "remove one <mimic>",
            "robot.mimic-loop");
    }
  }

 private:
  void fault(std::size_t mimicking, const std::string& problem, const std::string& fix,
             std::string_view code) {
    const JointDescription& joint = context_.robot.joints[mimicking];
    context_.fault(line_of(joint.lines.mimic, joint.line), of(joint), problem, fix, code);
  }

  void pair(std::size_t mimicking, std::size_t mimicked) {
    const JointDescription& joint = context_.robot.joints[mimicking];
    if (!std::isfinite(joint.mimic->multiplier) || !std::isfinite(joint.mimic->offset))
      fault(mimicking, "its <mimic> has a number that is not finite", "give finite numbers",
            "robot.not-finite");
    if (mimicked == kNone)
      return fault(mimicking, "it mimics joint '" + joint.mimic->joint + "', which does not exist",
                   "use the name of a joint of this robot", "robot.mimic-unknown");
    if (mimicked == mimicking)
      return fault(mimicking, "the joint mimics itself", "use the name of another joint",
                   "robot.mimic-itself");
    if (joint.dofs() == 0)
      return context_.warn(line_of(joint.lines.mimic, joint.line), of(joint),
                           "it is fixed: its <mimic> has no effect", "remove the <mimic>",
                           "robot.mimic-still");
    const JointDescription& other = context_.robot.joints[mimicked];
    for (const JointDescription* j : {&joint, &other})
      if (j->dofs() != 1)
        return fault(mimicking,
                     "it mimics " + of(other) + ", but " + of(*j) + " (" + to_string(j->type) +
                         ") has " + std::to_string(j->dofs()) + " coordinates",
                     kOneCoordinate, "robot.mimic-coordinates");
    if (joint.mimic->multiplier == 0)
      context_.warn(line_of(joint.lines.mimic, joint.line), of(joint),
                    "its <mimic> has multiplier 0: the position is constant (the offset)",
                    "make it a fixed joint", "robot.mimic-still");
    mimicked_[mimicking] = mimicked;
  }

  ValidationContext& context_;
  std::vector<std::size_t> mimicked_;
};

}  // namespace

void check_tree(ValidationContext& context) {
  TreeCheck(context).run();
}

void check_mimics(ValidationContext& context) {
  MimicCheck(context).run();
}

std::string find_root(const RobotDescription& robot) {
  const auto parent_joint = parent_joints(robot);
  std::string root;
  for (const LinkDescription& link : robot.links) {
    if (parent_joint.count(link.name)) continue;
    if (!root.empty()) return {};
    root = link.name;
  }
  return root;
}

// Equivalent to sweeps over the file that take every joint whose parent link is reached: a joint
// belongs to the sweep of the joint of its parent link if that one precedes it in the file, else to
// the next sweep.
std::vector<std::size_t> joints_from_root(const RobotDescription& robot) {
  const auto parent_joint = parent_joints(robot);
  std::vector<std::size_t> sweep(robot.joints.size(), kNone), order, path;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    path = {j};
    for (;;) {
      const auto previous = parent_joint.find(robot.joints[path.back()].parent);
      if (previous == parent_joint.end() || sweep[path.back()] != kNone) break;
      path.push_back(previous->second);
    }
    for (; !path.empty(); path.pop_back()) {
      const std::size_t i = path.back();
      const auto previous = parent_joint.find(robot.joints[i].parent);
      sweep[i] = previous == parent_joint.end()
                     ? 0
                     : sweep[previous->second] + (previous->second < i ? 0 : 1);
    }
    order.push_back(j);
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t joint) { return sweep[joint]; });
  return order;
}

}  // namespace twinarm
