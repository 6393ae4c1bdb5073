#include "collision/import/urdf/urdf.h"

#include <map>
#include <sstream>

#include "collision/import/robot/robot_check.h"
#include "solver/support/atomic_file.h"
#include "solver/support/number_text.h"
#include "solver/support/text.h"

namespace twinarm {
namespace {

std::string attribute(const std::string& name, const std::string& text) {
  return " " + name + "=\"" + escaped(text) + "\"";
}
std::string attribute(const std::string& name, double value) {
  return attribute(name, number_text(value));
}
template <int N>
std::string attribute(const std::string& name, const Eigen::Matrix<double, N, 1>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + number_text(value);
  return attribute(name, text);
}

// 0 is the default and not written; -0 is written.
bool is_plain_zero(const Vector3& v) {
  return v.isZero(0.0) && !std::signbit(v.x()) && !std::signbit(v.y()) && !std::signbit(v.z());
}

class Writer {
 public:
  Writer(const RobotDescription& robot, std::filesystem::path folder)
      : robot_(robot), folder_(std::move(folder)) {}

  std::string text(const std::string& comment) {
    out_ << "<?xml version=\"1.0\"?>\n";
    std::istringstream lines(comment);
    for (std::string line; std::getline(lines, line);) {
      // "--" must not stand in an XML comment
      for (auto at = line.find("--"); at != std::string::npos; at = line.find("--"))
        line.replace(at, 2, "- -");
      out_ << "<!-- " << line << " -->\n";
    }
    out_ << "<robot" << attribute("name", robot_.name) << ">\n";
    write_materials();
    for (const LinkDescription& l : robot_.links) link(l);
    for (const JointDescription& j : robot_.joints) joint(j);
    out_ << "</robot>\n";
    return out_.str();
  }

 private:
  // One definition per name; visuals that differ from it have their own.
  void write_materials() {
    for (const LinkDescription& link : robot_.links)
      for (const VisualPart& part : link.visuals)
        if (!part.material.empty() && materials_.emplace(part.material, material_text(part)).second)
          out_ << "  <material" << attribute("name", part.material) << ">" << material_text(part)
               << "</material>\n";
  }

  std::string material_text(const VisualPart& part) {
    const std::string color = "<color" + attribute<4>("rgba", part.color) + "/>";
    if (part.texture_name.empty()) return color;
    return color + "<texture" + attribute("filename", file_text(part.texture, part.texture_name)) +
           "/>";
  }

  std::string file_text(const std::filesystem::path& file, const std::string& name) {
    if (file.empty()) return name;
    const auto relative = file.lexically_relative(folder_);
    return (relative.empty() ? file : relative).generic_string();
  }

  void origin(const char* indent, const Origin& origin) {
    if (is_plain_zero(origin.xyz) && is_plain_zero(origin.rpy)) return;
    out_ << indent << "<origin" << attribute<3>("xyz", origin.xyz)
         << attribute<3>("rpy", origin.rpy) << "/>\n";
  }

  template <class S>
  std::string shape(const S& shape) {
    std::string text = std::string("<") + shape.key;
    if constexpr (requires { shape.is_in_urdf; })
      for_each_length(shape,
                      [&](const char* name, const auto& value) { text += attribute(name, value); });
    return text;
  }
  std::string shape(const MeshGeometry& mesh) {
    return "<mesh" + attribute("filename", file_text(mesh.file, mesh.name)) +
           (mesh.scale == Vector3::Ones() ? "" : attribute<3>("scale", mesh.scale));
  }

  template <class Part>
  void placed_shape(const char* tag, const Part& part) {
    out_ << "    <" << tag << (part.name.empty() ? "" : attribute("name", part.name)) << ">\n";
    origin("      ", part.origin);
    out_ << "      <geometry>"
         << std::visit([this](const auto& geometry) { return this->shape(geometry); },
                       part.geometry)
         << "/></geometry>\n";
  }

  void link(const LinkDescription& link) {
    out_ << "  <link" << attribute("name", link.name) << ">\n";
    if (link.has_inertia) {
      const Matrix3& I = link.inertia;
      out_ << "    <inertial>\n";
      origin("      ", {link.com, Vector3::Zero()});
      out_ << "      <mass" << attribute("value", link.mass) << "/>\n      <inertia"
           << attribute("ixx", I(0, 0)) << attribute("ixy", I(0, 1)) << attribute("ixz", I(0, 2))
           << attribute("iyy", I(1, 1)) << attribute("iyz", I(1, 2)) << attribute("izz", I(2, 2))
           << "/>\n    </inertial>\n";
    }
    for (const VisualPart& part : link.visuals) {
      placed_shape("visual", part);
      const auto known = materials_.find(part.material);
      if (known != materials_.end() && known->second == material_text(part))
        out_ << "      <material" << attribute("name", part.material) << "/>\n";
      else
        out_ << "      <material" << attribute("name", part.material) << ">" << material_text(part)
             << "</material>\n";
      out_ << "    </visual>\n";
    }
    for (const CollisionPart& part : link.collisions) {
      placed_shape("collision", part);
      out_ << "    </collision>\n";
    }
    out_ << "  </link>\n";
  }

  void joint(const JointDescription& joint) {
    out_ << "  <joint" << attribute("name", joint.name)
         << attribute("type", to_string(urdf_type_of(joint.type, joint.is_limited())))
         << ">\n    <parent" << attribute("link", joint.parent) << "/>\n    <child"
         << attribute("link", joint.child) << "/>\n";
    origin("    ", joint.origin);
    if (joint.has_axis()) out_ << "    <axis" << attribute<3>("xyz", joint.axis) << "/>\n";
    const bool has_effort = joint.effort != 0 || joint.velocity != 0;
    if (joint.is_limited() || has_effort) {
      out_ << "    <limit";
      if (joint.is_limited())
        out_ << attribute("lower", joint.lower) << attribute("upper", joint.upper);
      out_ << attribute("effort", joint.effort) << attribute("velocity", joint.velocity) << "/>\n";
    }
    if (joint.damping != 0 || joint.friction != 0)
      out_ << "    <dynamics" << attribute("damping", joint.damping)
           << attribute("friction", joint.friction) << "/>\n";
    if (joint.mimic)
      out_ << "    <mimic" << attribute("joint", joint.mimic->joint)
           << attribute("multiplier", joint.mimic->multiplier)
           << attribute("offset", joint.mimic->offset) << "/>\n";
    extension(joint);
    out_ << "  </joint>\n";
  }

  void extension(const JointDescription& joint) {
    std::string text;
    if (!is_urdf_type(joint.type)) text += attribute("type", to_string(joint.type));
    if (joint.type == JointDescription::Type::screw) text += attribute("pitch", joint.pitch);
    if (joint.armature != 0) text += attribute("armature", joint.armature);
    if (joint.coulomb_plus != joint.friction) text += attribute("coulomb_plus", joint.coulomb_plus);
    if (joint.coulomb_minus != joint.friction)
      text += attribute("coulomb_minus", joint.coulomb_minus);
    if (!text.empty()) out_ << "    <twinarm" << text << "/>\n";
  }

  const RobotDescription& robot_;
  const std::filesystem::path folder_;
  std::map<std::string, std::string> materials_;  // by material
  std::ostringstream out_;
};

}  // namespace

std::string urdf_text(const RobotDescription& robot, const std::filesystem::path& folder,
                      const std::string& comment) {
  const auto absolute = std::filesystem::absolute(folder).lexically_normal();
  return Writer(robot, absolute).text(comment);
}

void write_urdf(const RobotDescription& robot, const std::filesystem::path& file,
                const std::string& comment) {
  const auto absolute = std::filesystem::absolute(file).lexically_normal();
  write_whole_file(absolute, urdf_text(robot, absolute.parent_path(), comment));
}

}  // namespace twinarm
