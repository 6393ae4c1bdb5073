// The links and joints form one tree. Every walk is linear in the number of joints.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "collision/import/robot/robot_validation.h"

namespace twinarm {
namespace {

class TreeRules {
 public:
  explicit TreeRules(RuleBook& book) : book_(book), robot_(book.robot) {}

  void run() {
    const bool children_known = references();
    single_parents();
    const bool acyclic = no_loops();
    // A joint that names an unknown child makes a false root of the link that was meant.
    if (children_known) one_root();
    if (acyclic && book_.found.faults.empty()) moving_links_have_mass();
  }

 private:
  bool references() {
    std::set<std::string> names;
    for (const LinkDescription& link : robot_.links) names.insert(link.name);
    const auto known = [&](const JointDescription& joint, const std::string& link, int line,
                           const std::string& role) {
      if (names.count(link)) return true;
      book_.fault(line_of(line, joint.line), of(joint),
                  "its " + role + " link " +
                      (link.empty() ? "is not given" : "'" + link + "' does not exist"),
                  "name a link of this robot", "robot.link-unknown");
      return false;
    };
    bool children_known = true;
    for (const JointDescription& joint : robot_.joints) {
      known(joint, joint.parent, joint.lines.parent, "parent");
      children_known = known(joint, joint.child, joint.lines.child, "child") && children_known;
    }
    return children_known;
  }

  // Fills parent_joint_ as it goes; the first joint that claims a link keeps it.
  void single_parents() {
    for (const JointDescription& joint : robot_.joints) {
      const auto [first, is_new] = parent_joint_.emplace(joint.child, &joint);
      if (!is_new)
        book_.fault(joint.line, of(joint),
                    "its child link '" + joint.child + "' has a parent already, by " +
                        of(*first->second) + " of line " + std::to_string(first->second->line),
                    "a robot is a tree: give each link one parent, and close loops by a constraint",
                    "robot.two-parents");
    }
  }

  // Each loop is told once, at that joint of it that stands first in the file. A walk upwards stops
  // where an earlier one has been; where it meets itself, there is a loop.
  bool no_loops() {
    bool acyclic = true;
    std::map<std::string, std::size_t> walk;  // which walk came by this link
    for (std::size_t start = 0; start < robot_.joints.size(); ++start) {
      std::vector<std::string> path;  // from the child upwards
      std::string link = robot_.joints[start].child;
      auto up = parent_joint_.end();
      while (walk.emplace(link, start).second) {
        path.push_back(link);
        up = parent_joint_.find(link);
        if (up == parent_joint_.end()) break;  // the root
        link = up->second->parent;
      }
      if (path.empty() || up == parent_joint_.end() || walk.at(link) != start) continue;
      acyclic = false;
      tell_loop({std::find(path.begin(), path.end(), link), path.end()});
    }
    return acyclic;
  }

  void tell_loop(const std::vector<std::string>& loop) {  // each link's parent is the next one
    const JointDescription* first = parent_joint_.at(loop.front());
    std::string text;
    for (auto link = loop.rbegin(); link != loop.rend(); ++link) {
      const JointDescription* up = parent_joint_.at(*link);
      if (up->line < first->line) first = up;
      text += up->parent + " -> ";
    }
    book_.fault(first->line, of(*first), "its links form a loop: " + text + loop.front(),
                "a robot is a tree: leave one joint out, and close the loop by a constraint",
                "robot.loop");
  }

  void one_root() {
    const LinkDescription* first = nullptr;
    for (const LinkDescription& link : robot_.links) {
      if (parent_joint_.count(link.name) || link.name.empty()) continue;
      if (first && first->name != link.name)
        book_.fault(link.line, of(link),
                    "it has no parent, and '" + first->name + "' of line " +
                        std::to_string(first->line) + " has none either: a robot has one root",
                    "join it to the tree, with a fixed joint if it does not move",
                    "robot.two-roots");
      if (!first) first = &link;
    }
  }

  // A warning only: what is drawn or only moved needs no mass, and payloads may be added later.
  void moving_links_have_mass() {
    for (const std::size_t j : joints_without_inertia(robot_)) {
      const JointDescription& joint = robot_.joints[j];
      book_.warn(joint.line, of(joint),
                 "neither link '" + joint.child + "' nor anything outward of it has mass",
                 "dynamics needs mass and inertia there, or a fixed joint");
    }
  }

  RuleBook& book_;
  const RobotDescription& robot_;
  std::map<std::string, const JointDescription*> parent_joint_;  // by the name of the child
};

// By child link, the joint that carries it.
std::map<std::string, std::size_t> carriers(const RobotDescription& robot) {
  std::map<std::string, std::size_t> carrier;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) carrier.emplace(robot.joints[j].child, j);
  return carrier;
}

}  // namespace

void check_tree(RuleBook& book) {
  TreeRules(book).run();
}

std::string find_root(const RobotDescription& robot) {
  const auto carrier = carriers(robot);
  std::string root;
  for (const LinkDescription& link : robot.links) {
    if (carrier.count(link.name)) continue;
    if (!root.empty()) return {};
    root = link.name;
  }
  return root;
}

// As if the file were swept again and again, each time taking every joint whose parent link has
// been reached by then: a joint is taken in the sweep of its inward neighbour if that one stands
// before it in the file, and in the next sweep if not.
std::vector<std::size_t> joints_from_root(const RobotDescription& robot) {
  const auto carrier = carriers(robot);
  constexpr std::size_t kUnknown = static_cast<std::size_t>(-1);
  std::vector<std::size_t> sweep(robot.joints.size(), kUnknown), order, path;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    path = {j};
    for (;;) {
      const auto inward = carrier.find(robot.joints[path.back()].parent);
      if (inward == carrier.end() || sweep[path.back()] != kUnknown) break;
      path.push_back(inward->second);
    }
    for (; !path.empty(); path.pop_back()) {
      const std::size_t i = path.back();
      const auto inward = carrier.find(robot.joints[i].parent);
      sweep[i] = inward == carrier.end() ? 0 : sweep[inward->second] + (inward->second < i ? 0 : 1);
    }
    order.push_back(j);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sweep[a] < sweep[b]; });
  return order;
}

std::vector<std::size_t> joints_without_inertia(const RobotDescription& robot) {
  std::set<std::string> heavy;
  for (const LinkDescription& link : robot.links)
    if (link.has_inertia && (link.mass > 0 || !link.inertia.isZero(0))) heavy.insert(link.name);
  const std::vector<std::size_t> order = joints_from_root(robot);
  for (auto j = order.rbegin(); j != order.rend(); ++j)
    if (heavy.count(robot.joints[*j].child)) heavy.insert(robot.joints[*j].parent);
  std::vector<std::size_t> found;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const JointDescription& joint = robot.joints[j];
    // A rotor is an inertia too, and a joint that follows another has no motion of its own.
    const bool moves = joint.dofs() > 0 && joint.armature == 0 && !joint.mimic;
    if (moves && !heavy.count(joint.child)) found.push_back(j);
  }
  return found;
}

}  // namespace twinarm
