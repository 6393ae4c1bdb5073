// The links and joints form one tree, and joints that follow others (mimics) come to one that
// leads. Every walk is linear in the number of joints.
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

// By child link, the joint that carries it: the first that claims it.
std::map<std::string, std::size_t> carriers(const RobotDescription& robot) {
  std::map<std::string, std::size_t> carrier;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) carrier.emplace(robot.joints[j].child, j);
  return carrier;
}

// The loops of walks from each item to the next, each once, from where it was met first. A walk
// stops where an earlier one has been; where it meets itself, there is a loop.
std::vector<std::vector<std::size_t>> loops_of(const std::vector<std::size_t>& next) {
  std::vector<std::vector<std::size_t>> loops;
  std::vector<std::size_t> walk(next.size(), kNone);  // which walk came by
  for (std::size_t start = 0; start < next.size(); ++start) {
    std::size_t at = start;
    for (; at != kNone && walk[at] == kNone; at = next[at]) walk[at] = start;
    if (at == kNone || walk[at] != start) continue;
    loops.emplace_back(1, at);
    for (std::size_t i = next[at]; i != at; i = next[i]) loops.back().push_back(i);
  }
  return loops;
}

class TreeRules {
 public:
  explicit TreeRules(ValidationContext& book)
      : book_(book), robot_(book.robot), carrier_(carriers(book.robot)) {}

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

  void single_parents() {
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      const JointDescription& joint = robot_.joints[j];
      const JointDescription& first = robot_.joints[carrier_.at(joint.child)];
      if (&first != &joint)
        book_.fault(joint.line, of(joint),
                    "its child link '" + joint.child + "' has a parent already, by " + of(first) +
                        " of line " + std::to_string(first.line),
                    "a robot is a tree: give each link one parent, and close loops by a constraint",
                    "robot.two-parents");
    }
  }

  // Each loop is reported once, at that joint of it that stands first in the file.
  bool no_loops() {
    std::vector<std::size_t> inward;  // by joint, the one that carries its parent
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      const JointDescription& joint = robot_.joints[j];
      const std::size_t first = carrier_.at(joint.child);
      const auto up = carrier_.find(joint.parent);
      inward.push_back(first != j ? first : up == carrier_.end() ? kNone : up->second);
    }
    const auto loops = loops_of(inward);
    for (const std::vector<std::size_t>& loop : loops) {
      const JointDescription* first = &robot_.joints[loop.front()];
      std::string text;
      for (auto j = loop.rbegin(); j != loop.rend(); ++j) {
        const JointDescription& joint = robot_.joints[*j];
        if (joint.line < first->line) first = &joint;
        text += joint.parent + " -> ";
      }
      book_.fault(first->line, of(*first),
                  "its links form a loop: " + text + robot_.joints[loop.front()].child,
                  "a robot is a tree: leave one joint out, and close the loop by a constraint",
                  "robot.loop");
    }
    return loops.empty();
  }

  void one_root() {
    const LinkDescription* first = nullptr;
    for (const LinkDescription& link : robot_.links) {
      if (carrier_.count(link.name) || link.name.empty()) continue;
      if (first && first->name != link.name)
        book_.fault(link.line, of(link),
                    "it has no parent, and '" + first->name + "' of line " +
                        std::to_string(first->line) + " has none either: a robot has one root",
                    "join it to the tree, with a fixed joint if it does not move",
                    "robot.two-roots");
      if (!first) first = &link;
    }
  }

  // A warning only: what is drawn or only moved needs no mass, and payloads may be added later. The
  // model builder refuses every joint whose acceleration nothing determines.
  void moving_links_have_mass() {
    std::set<std::string> heavy;
    for (const LinkDescription& link : robot_.links)
      if (link.has_inertia && (link.mass > 0 || !link.inertia.isZero(0))) heavy.insert(link.name);
    const std::vector<std::size_t> order = joints_from_root(robot_);
    for (auto j = order.rbegin(); j != order.rend(); ++j)
      if (heavy.count(robot_.joints[*j].child)) heavy.insert(robot_.joints[*j].parent);
    for (const JointDescription& joint : robot_.joints) {
      // A rotor is an inertia too, and a joint that follows another has no motion of its own.
      const bool moves = joint.dofs() > 0 && joint.armature == 0 && !joint.mimic;
      if (moves && !heavy.count(joint.child))
        book_.warn(joint.line, of(joint),
                   "neither link '" + joint.child + "' nor anything outward of it has mass",
                   "dynamics needs mass and inertia there, or a fixed joint", "robot.no-mass");
    }
  }

  ValidationContext& book_;
  const RobotDescription& robot_;
  const std::map<std::string, std::size_t> carrier_;
};

constexpr const char* kOneCoordinate =
    "only joints of one coordinate follow and lead: revolute, continuous, prismatic, screw";

// A joint that follows another one: both have one coordinate, and the one that leads does not
// follow in turn the one that it leads.
class MimicRules {
 public:
  explicit MimicRules(ValidationContext& book)
      : book_(book), leader_(book.robot.joints.size(), kNone) {}

  void run() {
    const auto& joints = book_.robot.joints;
    std::map<std::string, std::size_t> index;
    for (std::size_t j = 0; j < joints.size(); ++j) index.emplace(joints[j].name, j);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (!joints[j].mimic) continue;
      const auto found = index.find(joints[j].mimic->joint);
      pair(j, found == index.end() ? kNone : found->second);
    }
    // Each loop is reported once, at that joint of it that stands first in the file.
    for (const std::vector<std::size_t>& loop : loops_of(leader_)) {
      std::string text;
      for (const std::size_t j : loop) text += joints[j].name + " -> ";
      fault(*std::min_element(loop.begin(), loop.end()),
            "joints mimic each other in a loop: " + text + joints[loop.front()].name,
            "let one of them lead", "robot.mimic-loop");
    }
  }

 private:
  void fault(std::size_t follower, const std::string& problem, const std::string& fix,
             std::string_view code) {
    const JointDescription& joint = book_.robot.joints[follower];
    book_.fault(line_of(joint.lines.mimic, joint.line), of(joint), problem, fix, code);
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
                 "make it a fixed joint", "robot.mimic-still");
    leader_[follower] = leader;
  }

  ValidationContext& book_;
  std::vector<std::size_t> leader_;
};

}  // namespace

void check_tree(ValidationContext& book) {
  TreeRules(book).run();
}

void check_mimics(ValidationContext& book) {
  MimicRules(book).run();
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
  std::vector<std::size_t> sweep(robot.joints.size(), kNone), order, path;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    path = {j};
    for (;;) {
      const auto inward = carrier.find(robot.joints[path.back()].parent);
      if (inward == carrier.end() || sweep[path.back()] != kNone) break;
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

}  // namespace twinarm
