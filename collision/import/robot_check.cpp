// The rules that every robot must keep.
//
// Names are unique; every joint joins two links that exist; the links form one tree; what moves has
// a mass; a mass is positive; an inertia about the centre of mass is one that a body can have: with
// principal moments A <= B <= C, A > 0 and A + B >= C (the moments are integrals of y^2 + z^2,
// z^2 + x^2, x^2 + y^2 over the mass, and x^2 + y^2 <= (y^2 + z^2) + (z^2 + x^2)).
#include "collision/import/robot_check.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "collision/import/number_text.h"

namespace twinarm {
namespace {

using Type = JointDescription::Type;

constexpr std::array<std::pair<Type, const char*>, 5> kTypes{{{Type::fixed, "fixed"},
                                                              {Type::revolute, "revolute"},
                                                              {Type::continuous, "continuous"},
                                                              {Type::prismatic, "prismatic"},
                                                              {Type::floating, "floating"}}};

// How far A + B may fall below C, relative to C: a thin plate has A + B = C, and files round their
// numbers to six digits or so.
constexpr double kTriangleSlack = 1e-6;

// Works through one robot; every method adds what it finds.
class Checker {
 public:
  explicit Checker(const RobotDescription& robot) : robot_(robot), file_(robot.file.string()) {}

  std::vector<Fault> run() {
    if (robot_.links.empty())
      add(0, "robot '" + robot_.name + "'", "it has no link", "give at least one link");
    unique_names(robot_.links, "link");
    unique_names(robot_.joints, "joint");
    for (const LinkDescription& link : robot_.links) inertia(link);
    for (const JointDescription& joint : robot_.joints) values(joint);
    // A joint that names an unknown link makes false roots: the tree is judged only without those.
    if (references()) {
      single_parents();
      const bool acyclic = no_loops();
      one_root();
      if (acyclic) moving_links_have_mass();
    }
    return std::move(faults_);
  }

 private:
  void add(int line, std::string where, std::string rule, std::string remedy) {
    faults_.push_back({file_, line, std::move(where), std::move(rule), std::move(remedy)});
  }
  // The line of the element itself where it is known, of the link or joint where it is not.
  static int line_of(int element, int owner) { return element > 0 ? element : owner; }
  static std::string of(const LinkDescription& link) { return "link '" + link.name + "'"; }
  static std::string of(const JointDescription& joint) { return "joint '" + joint.name + "'"; }

  template <class Item>
  void unique_names(const std::vector<Item>& items, const std::string& kind) {
    std::map<std::string, int> first_line;
    for (const Item& item : items) {
      if (item.name.empty()) {
        add(item.line, kind, "it has no name", "give it a name of its own");
        continue;
      }
      const auto [first, is_new] = first_line.emplace(item.name, item.line);
      if (!is_new)
        add(item.line, of(item),
            "the name is taken already by the " + kind + " of line " +
                std::to_string(first->second),
            "give each " + kind + " a name of its own");
    }
  }

  void inertia(const LinkDescription& link) {
    if (!link.has_inertia) return;
    if (!(link.mass > 0))
      add(line_of(link.mass_line, link.line), of(link),
          "its mass is " + number_text(link.mass) + " kg, must be positive",
          "give the mass in kg, or leave <inertial> out where nothing of the link moves");
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(link.inertia, Eigen::EigenvaluesOnly);
    const Vector3 moments = solver.eigenvalues();  // ascending
    const std::string found = "principal moments " + number_text(moments[0]) + ", " +
                              number_text(moments[1]) + ", " + number_text(moments[2]) + " kg m^2";
    const int line = line_of(link.inertia_line, link.line);
    if (!(moments[0] > 0))
      add(line, of(link), "its inertia is not positive definite: " + found,
          "give the inertia about the centre of mass; a body of any size has three positive "
          "moments");
    else if (moments[0] + moments[1] < moments[2] * (1 - kTriangleSlack))
      add(line, of(link), "its inertia breaks the triangle inequality A + B >= C: " + found,
          "no body has such moments; check units, signs and the order ixx ixy ixz iyy iyz izz");
  }

  void values(const JointDescription& joint) {
    if (joint.has_axis() && joint.axis.norm() < 1e-9)
      add(line_of(joint.lines.axis, joint.line), of(joint), "its axis is zero",
          "give a direction such as 0 0 1");
    if (joint.is_limited() && !(joint.lower <= joint.upper))
      add(line_of(joint.lines.limits, joint.line), of(joint),
          "its lower limit " + number_text(joint.lower) + " lies above its upper limit " +
              number_text(joint.upper),
          "exchange them, or make the joint continuous");
    const auto not_negative = [&](const char* name, double value, int line) {
      if (value < 0)
        add(line_of(line, joint.line), of(joint),
            std::string("its ") + name + " is " + number_text(value) + ", must not be negative",
            "a negative value would feed energy into the joint");
    };
    const JointDescription::Lines& lines = joint.lines;
    not_negative("damping", joint.damping, lines.dynamics);
    not_negative("friction", joint.friction, lines.dynamics);
    not_negative("armature", joint.armature, lines.extension);
    // They are equal to the friction where they are not stated: that is told once.
    const double plus = joint.coulomb_plus, minus = joint.coulomb_minus;
    if (plus != joint.friction) not_negative("coulomb_plus", plus, lines.extension);
    if (minus != joint.friction) not_negative("coulomb_minus", minus, lines.extension);
  }

  bool references() {
    std::set<std::string> names;
    for (const LinkDescription& link : robot_.links) names.insert(link.name);
    bool all_known = true;
    const auto known = [&](const JointDescription& joint, const std::string& link, int line,
                           const std::string& role) {
      if (names.count(link)) return;
      all_known = false;
      add(line_of(line, joint.line), of(joint),
          "its " + role + " link " +
              (link.empty() ? "is not given" : "'" + link + "' does not exist"),
          "name a link of this robot");
    };
    for (const JointDescription& joint : robot_.joints) {
      known(joint, joint.parent, joint.lines.parent, "parent");
      known(joint, joint.child, joint.lines.child, "child");
    }
    return all_known;
  }

  // Fills parent_joint_ as it goes; the first joint that claims a link keeps it.
  void single_parents() {
    for (const JointDescription& joint : robot_.joints) {
      const auto [first, is_new] = parent_joint_.emplace(joint.child, &joint);
      if (!is_new)
        add(joint.line, of(joint),
            "its child link '" + joint.child + "' has a parent already, by " + of(*first->second) +
                " of line " + std::to_string(first->second->line),
            "a robot is a tree: give each link one parent, and close loops by a constraint");
    }
  }

  // Each loop is told once, at that joint of it that stands first in the file.
  bool no_loops() {
    bool acyclic = true;
    std::set<std::string> done;
    for (const JointDescription& joint : robot_.joints) {
      std::vector<std::string> path;  // from the child upwards
      std::string link = joint.child;
      const auto position = [&] { return std::find(path.begin(), path.end(), link); };
      bool has_parent = true;
      while (has_parent && !done.count(link) && position() == path.end()) {
        path.push_back(link);
        has_parent = parent_joint_.count(link) > 0;
        if (has_parent) link = parent_joint_.at(link)->parent;
      }
      // The walk came back to a link of its own path: from there on the path is a loop.
      if (has_parent && position() != path.end()) {
        acyclic = false;
        tell_loop({position(), path.end()});
      }
      done.insert(path.begin(), path.end());
    }
    return acyclic;
  }

  void tell_loop(const std::vector<std::string>& loop) {  // each link's parent is the next one
    const JointDescription* first = parent_joint_.at(loop.front());
    std::string text = loop.front();
    for (const std::string& link : loop) {
      const JointDescription* up = parent_joint_.at(link);
      if (up->line < first->line) first = up;
      text = up->parent + " -> " + text;
    }
    add(first->line, of(*first), "its links form a loop: " + text,
        "a robot is a tree: leave one joint out, and close the loop by a constraint");
  }

  void one_root() {
    const LinkDescription* first = nullptr;
    for (const LinkDescription& link : robot_.links) {
      if (parent_joint_.count(link.name) || link.name.empty()) continue;
      if (first && first->name != link.name)
        add(link.line, of(link),
            "it has no parent, and '" + first->name + "' of line " + std::to_string(first->line) +
                " has none either: a robot has one root",
            "join it to the tree, with a fixed joint if it does not move");
      if (!first) first = &link;
    }
  }

  // Links that are joined by fixed joints are one body. The root's body stands on the world and may
  // be without mass; every other body needs one, by any of its links.
  void moving_links_have_mass() {
    const auto body_of = [&](std::string link) {
      for (auto up = parent_joint_.find(link);
           up != parent_joint_.end() && up->second->type == Type::fixed;
           up = parent_joint_.find(link))
        link = up->second->parent;
      return link;
    };
    std::set<std::string> bodies_with_mass;
    for (const LinkDescription& link : robot_.links)
      if (link.has_inertia) bodies_with_mass.insert(body_of(link.name));
    for (const LinkDescription& link : robot_.links) {
      const auto up = parent_joint_.find(link.name);
      const bool starts_a_moving_body =
          up != parent_joint_.end() && up->second->type != Type::fixed;
      if (starts_a_moving_body && !bodies_with_mass.count(link.name))
        add(link.line, of(link), "it moves (by " + of(*up->second) + ") but has no inertia",
            "give mass and inertia; only a root that stands on the world, and links fixed to a "
            "body "
            "that has them, may be without");
    }
  }

  const RobotDescription& robot_;
  std::string file_;
  std::vector<Fault> faults_;
  std::map<std::string, const JointDescription*> parent_joint_;  // by the name of the child
};

}  // namespace

const char* to_string(Type type) {
  for (const auto& [value, name] : kTypes)
    if (value == type) return name;
  return "";
}

bool joint_type_from(const std::string& text, Type& type) {
  for (const auto& [value, name] : kTypes)
    if (text == name) {
      type = value;
      return true;
    }
  return false;
}

std::vector<Fault> check_robot(const RobotDescription& robot) {
  return Checker(robot).run();
}

void throw_in_line_order(std::vector<Fault> faults) {
  std::stable_sort(faults.begin(), faults.end(),
                   [](const Fault& a, const Fault& b) { return a.line < b.line; });
  if (!faults.empty()) throw InputError(std::move(faults));
}

std::string find_root(const RobotDescription& robot) {
  std::set<std::string> children;
  for (const JointDescription& joint : robot.joints) children.insert(joint.child);
  std::string root;
  for (const LinkDescription& link : robot.links) {
    if (children.count(link.name)) continue;
    if (!root.empty()) return {};
    root = link.name;
  }
  return root;
}

std::vector<std::size_t> joints_from_root(const RobotDescription& robot) {
  std::set<std::string> reached{robot.root};
  std::vector<bool> taken(robot.joints.size(), false);
  std::vector<std::size_t> order;
  for (bool grew = true; grew;) {
    grew = false;
    for (std::size_t i = 0; i < robot.joints.size(); ++i) {
      if (taken[i] || !reached.count(robot.joints[i].parent)) continue;
      taken[i] = grew = true;
      reached.insert(robot.joints[i].child);
      order.push_back(i);
    }
  }
  return order;
}

}  // namespace twinarm
