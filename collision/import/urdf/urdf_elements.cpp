#include "collision/import/urdf/urdf_parts.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace twinarm {

namespace {

using Names = std::vector<std::string_view>;

struct Word {
  std::string_view element;
  Names attributes;
  Names children;        // each has its own entry
  Names without_effect;  // known children that are ignored
};

// <geometry>, and each shape with its dimensions.
void add_shapes(std::vector<Word>& words) {
  Word geometry{"geometry", {}, {"mesh"}, {}};
  for_each_shape([&](const auto& shape) {
    if constexpr (requires { shape.is_in_urdf; }) {
      Word word{shape.key, {}, {}, {}};
      for_each_length(shape,
                      [&](const char* name, const auto&) { word.attributes.push_back(name); });
      words.push_back(word);
      geometry.children.push_back(shape.key);
    }
  });
  words.push_back(geometry);
}

// An element has the same attributes and children everywhere.
std::vector<Word> vocabulary() {
  std::vector<Word> words = {
      {"robot",
       {"name", "version"},
       {"link", "joint", "material"},
       {"transmission", "gazebo", "ros2_control", "sensor", "mujoco"}},
      {"material", {"name"}, {"color", "texture"}, {}},
      {"color", {"rgba"}, {}, {}},
      {"texture", {"filename"}, {}, {}},
      {"link", {"name"}, {"inertial", "visual", "collision"}, {"sensor", "gazebo", "contact"}},
      {"inertial", {}, {"origin", "mass", "inertia"}, {}},
      {"origin", {"xyz", "rpy", "quat_xyzw"}, {}, {}},
      {"mass", {"value"}, {}, {}},
      {"inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, {}, {}},
      {"visual", {"name"}, {"origin", "geometry", "material"}, {}},
      {"collision", {"name"}, {"origin", "geometry"}, {"verbose", "contact_coefficients"}},
      {"mesh", {"filename", "scale"}, {}, {}},
      {"joint",
       {"name", "type"},
       {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic", "twinarm"},
       {"safety_controller", "calibration", "sensor", "gazebo"}},
      {"parent", {"link"}, {}, {}},
      {"child", {"link"}, {}, {}},
      {"axis", {"xyz"}, {}, {}},
      {"limit", {"lower", "upper", "effort", "velocity"}, {}, {}},
      {"dynamics", {"damping", "friction"}, {}, {}},
      {"mimic", {"joint", "multiplier", "offset"}, {}, {}},
      {"twinarm", {"type", "pitch", "armature", "coulomb_plus", "coulomb_minus"}, {}, {}},
  };
  add_shapes(words);
  return words;
}

bool contains(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const Word& word_of(std::string_view element) {
  static const std::vector<Word> words = vocabulary();
  return *std::ranges::find(words, element, &Word::element);
}

void check_attributes(const XmlElement& element, const Word& word, const std::string& where,
                      UrdfSource& source) {
  for (const auto& [name, value, line] : element.attributes) {
    if (contains(word.attributes, name) || name.starts_with("xmlns")) continue;
    source.warn_once("attribute " + std::string(word.element) + " " + name, line, where,
                     "unknown attribute '" + name + "' of <" + element.name + ">",
                     "it is ignored; check its spelling", "urdf.unknown-attribute");
  }
}

void check_element(const XmlElement& element, const Word& word, const std::string& owner,
                   UrdfSource& source) {
  std::string where = owner;
  if (word.element == "link" || word.element == "joint") {
    const char* name = element.value("name");
    where = std::string(word.element) + " '" + (name ? name : "") + "'";
  }
  check_attributes(element, word, where, source);
  for (const XmlElement& e : element.children) {
    const std::string& name = e.name;
    if (contains(word.children, name)) {
      check_element(e, word_of(name), where, source);
    } else if (name.starts_with("xacro:")) {
      source.fault(e.line, "<" + name + ">", "this is a xacro file",
                   "expand it first (xacro robot.urdf.xacro > robot.urdf)", "urdf.xacro");
    } else if (contains(word.without_effect, name)) {
      source.warn_once("element " + name, e.line, where, "<" + name + "> has no effect",
                       "it is ignored; other programs use it", "urdf.no-effect");
    } else if (word.element != "geometry") {  // unknown shapes: read_geometry()
      source.warn_once("element " + std::string(word.element) + " " + name, e.line, where,
                       "unknown element <" + name + "> in <" + element.name + ">",
                       "it is ignored; check its spelling", "urdf.unknown-element");
    }
  }
}

}  // namespace

void check_vocabulary(const XmlElement& robot, UrdfSource& source) {
  check_element(robot, word_of("robot"), "robot", source);
}

}  // namespace twinarm
