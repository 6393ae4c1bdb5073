#include "app/study/study_scene.h"

#include <fmt/format.h>

#include <iomanip>
#include <sstream>

#include "app/support/files.h"
#include "coupling/device/device_motion.h"
#include "coupling/target/target_robot.h"

namespace twinarm {
namespace {

std::string toml_string(const std::string& text) {
  std::ostringstream out;
  out << std::quoted(text);
  return out.str();
}

// All digits, with a decimal point: a TOML float.
std::string real(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string list(const Vector3& v) {
  return "[" + real(v.x()) + ", " + real(v.y()) + ", " + real(v.z()) + "]";
}

class SceneWriter {
 public:
  explicit SceneWriter(const StudyScene& scene)
      : scene_(scene),
        settings_(*scene.settings),
        robot_(*scene.robot),
        model_(robot_.dvr_model(scene.spec.coupling.type)) {}

  std::string text() {
    const RunSpec& spec = scene_.spec;
    text_ =
        fmt::format("# {} of the study: {}. Written by `twinarm study`.\n", spec.name, spec.title);
    line("step", real(spec.step()));
    if (const double lasts = scene_.hand.source->duration(); lasts > 0)
      line("duration", real(lasts));
    if (scene_.obstacle) line("contact", "\"compliant\"");
    write_robot();
    if (scene_.obstacle) write_obstacle();
    write_coupling();
    write_auxiliary();
    write_stops();
    return text_;
  }

 private:
  void line(const char* key, const std::string& value) {
    text_ += fmt::format("{} = {}\n", key, value);
  }
  void table(const char* name) { text_ += fmt::format("\n[[{}]]\n", name); }
  const std::string& link_of(int body) const {
    return model_.body_name[static_cast<std::size_t>(body)];
  }

  void write_robot() {
    const ModelOptions& masses = robot_.masses(scene_.spec.coupling.type);
    table("robot");
    line("name", toml_string(robot_.name()));
    line("model", toml_string(model_file()));
    line("limits", "false");  // the gripper has stops, below
    if (!scene_.obstacle) line("collide", "false");
    std::vector<std::string> scales, loads;
    for (const auto& [link, factor] : masses.mass_scale)
      scales.push_back(toml_string(link) + " = " + real(factor));
    for (const PointMass& load : masses.added_masses)
      loads.push_back(fmt::format("{{ link = {}, point = {}, mass = {} }}", toml_string(load.link),
                                  list(load.p_L), real(load.mass)));
    if (!scales.empty()) line("mass_scale", fmt::format("{{ {} }}", fmt::join(scales, ", ")));
    if (!loads.empty()) line("payload", fmt::format("[{}]", fmt::join(loads, ", ")));
    line("q", start());
  }

  // Of shipped assets their name, so that the scene works on another machine too.
  std::string model_file() const {
    const std::filesystem::path urdf = std::filesystem::absolute(settings_.urdf).lexically_normal(),
                                shipped =
                                    std::filesystem::absolute(find_assets()).lexically_normal();
    const std::string name = urdf.lexically_relative(shipped).string();
    return name.empty() || name.starts_with("..") ? urdf.string() : name;
  }

  // The DVR starts in the pose of the KVR.
  std::string start() const {
    const TargetRobot kvr(robot_.kvr_model(), *scene_.hand.source, OperatorMapping{},
                          robot_.joints());
    std::vector<std::string> moved = robot_.joints().turned;
    moved.push_back(robot_.joints().gripper);
    for (std::string& joint : moved) {
      const auto body = static_cast<std::size_t>(model_.find_joint(joint));
      joint = toml_string(joint) + " = " + real(kvr.start().x.q[model_.iq[body]]);
    }
    return fmt::format("{{ {} }}", fmt::join(moved, ", "));
  }

  void write_obstacle() {
    table("body");
    line("name", "\"box\"");
    line("fixed", "true");
    line("shape", "{ box = { size = " + list(scene_.obstacle->size) + " } }");
    line("position", list(scene_.obstacle->position));
    table("pair");
    line("a", toml_string(robot_.name()));
    line("b", "\"box\"");
    line("friction", real(settings_.contact_friction));
    line("stiffness", real(settings_.contact_stiffness));
    line("dissipation", real(settings_.contact_dissipation));
    for (const std::string& b : {std::string("box"), robot_.name()}) {
      table("pair");  // no contacts of the base, none between links
      line("a", toml_string(b == "box" ? robot_.name() + "/" + link_of(1) : b));
      line("b", toml_string(b));
      line("collide", "false");
    }
  }

  void write_hand() {
    const DrivenJoints& joints = robot_.joints();
    line("target", scene_.hand.target);
    line("gripper",
         fmt::format("{{ joint = {}, open = {}, closed = {} }}", toml_string(joints.gripper),
                     real(joints.gripper_open), real(joints.gripper_closed)));
  }

  void write_coupling() {
    const CouplingSpec& coupling = scene_.spec.coupling;
    const bool linear = coupling.type == CouplingSpec::Type::linear;
    for (const Spring& spring : robot_.springs(scene_.spec.gains)) {
      table("coupling");
      line("name", toml_string("pull_" + spring.name));
      line("type", toml_string(facts_of(coupling.type, coupling.printed).name));
      line("link", toml_string(link_of(spring.body)));
      if (linear) line("point", list(spring.p_L));
      if (!coupling.printed) line("discretization", toml_string(discretization_name(coupling)));
      line("stiffness", real(spring.k));
      line("damping", real(spring.b));
      write_hand();
    }
  }

  void write_auxiliary() {
    for (const CouplingSpec& held : robot_.auxiliary())
      for (const Spring& spring : held.springs) {
        table("coupling");
        line("name", toml_string("hold_" + spring.name));
        line("type", "\"torsional\"");
        line("measure", "\"joint\"");
        line("link", toml_string(link_of(spring.body)));
        line("stiffness", real(spring.k));
        line("damping", real(spring.b));
        write_hand();
      }
  }

  void write_stops() {
    for (const JointStops::Stop& stop : robot_.stops()) {
      table("coupling");
      line("name", toml_string("stop_" + model_.joint_name[static_cast<std::size_t>(stop.body)]));
      line("type", "\"torsional\"");
      line("measure", "\"joint\"");
      line("link", toml_string(link_of(stop.body)));
      line("soft_limits", "[" + real(stop.lower) + ", " + real(stop.upper) + "]");
      line("stiffness", real(stop.k));
      line("damping", real(stop.b));
    }
  }

  const StudyScene& scene_;
  const StudySettings& settings_;
  const StudyRobot& robot_;
  const Model<double>& model_;
  std::string text_;
};

}  // namespace

StudyOperator automatic_operator() {
  static const AutomaticMotion motion{OperatorMapping{}};
  return {"\"paper\"", &motion};
}

StudyOperator device_operator() {
  static const DeviceMotion at_zero(1);
  return {"\"device\"", &at_zero};
}

StudyOperator synthetic_study_operator(const OperatorMotion& source, unsigned seed,
                                       const SyntheticRanges& ranges) {
  const auto range = [](const std::array<double, 2>& r) {
    return fmt::format("[{}, {}]", real(r[0]), real(r[1]));
  };
  return {fmt::format("{{ seed = {}, duration = {}, peak_speed = {}, tremor = {} }}", seed,
                      real(source.duration()), range(ranges.peak_speed), range(ranges.tremor)),
          &source};
}

StudyOperator traced_operator(const OperatorMotion& source, const std::filesystem::path& trace) {
  return {toml_string(std::filesystem::absolute(trace).lexically_normal().string()), &source};
}

std::string scene_text(const StudyScene& scene) {
  return SceneWriter(scene).text();
}

}  // namespace twinarm
