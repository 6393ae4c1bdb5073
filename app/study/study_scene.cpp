#include "app/study/study_run.h"

#include <fmt/format.h>

#include "app/support/files.h"
#include "coupling/device/device_motion.h"

namespace twinarm {
namespace {

struct SceneWriter {
  const StudyScene& scene;
  const StudySettings& settings = *scene.settings;
  const StudyRobot& study_robot = *scene.robot;
  const Model<double>& model = study_robot.dvr_model(scene.spec.coupling.type);

  std::string text() {
    const RunSpec& spec = scene.spec;
    Value root = Value::table({{"step", Value::of(spec.step())}});
    if (const double lasts = scene.hand.source->duration(); lasts > 0)
      root.put("duration", Value::of(lasts));
    if (scene.obstacle) root.put("contact", Value::of("compliant"));
    root.put("robot", Value::list({robot()}));
    if (scene.obstacle) put_obstacle(root);
    root.put("coupling", couplings());
    return fmt::format("# {} of the study: {}. Written by `twinarm study`.\n{}", spec.name,
                       spec.title, to_toml(root));
  }

  const std::string& link_of(int body) const {
    return model.body_name[static_cast<std::size_t>(body)];
  }

  Value robot() const {
    const ModelOptions& masses = study_robot.masses(scene.spec.coupling.type);
    Value robot = Value::table({{"name", Value::of(study_robot.name())},
                                {"model", Value::of(model_file())},
                                {"limits", Value::flag(false)}});  // the gripper has stops, below
    if (!scene.obstacle) robot.put("collide", Value::flag(false));
    Value scales, loads = Value::list({});
    for (const auto& [link, factor] : masses.mass_scale) scales.put(link, Value::of(factor));
    for (const PointMass& load : masses.added_masses)
      loads.items.push_back(Value::table({{"link", Value::of(load.link)},
                                          {"point", Value::numbers(load.p_L)},
                                          {"mass", Value::of(load.mass)}}));
    if (!scales.members.empty()) robot.put("mass_scale", scales);
    if (!loads.items.empty()) robot.put("payload", loads);
    robot.put("q", start());
    return robot;
  }

  // Of shipped assets their name, so that the scene works on another machine too.
  std::string model_file() const {
    const std::filesystem::path urdf = std::filesystem::absolute(settings.urdf).lexically_normal(),
                                shipped =
                                    std::filesystem::absolute(find_assets()).lexically_normal();
    const std::string name = urdf.lexically_relative(shipped).string();
    return name.empty() || name.starts_with("..") ? urdf.string() : name;
  }

  // The DVR starts in the pose of the KVR.
  Value start() const {
    const TargetRobot kvr(study_robot.kvr_model(), *scene.hand.source, OperatorMapping{},
                          study_robot.joints());
    std::vector<std::string> moved = study_robot.joints().turned;
    moved.push_back(study_robot.joints().gripper);
    Value q;
    for (const std::string& joint : moved) {
      const auto body = static_cast<std::size_t>(model.find_joint(joint));
      q.put(joint, Value::of(kvr.start().x.q[model.iq[body]]));
    }
    return q;
  }

  void put_obstacle(Value& root) const {
    const Value box = Value::of("box"), name = Value::of(study_robot.name());
    const Value shape = Value::table({{"size", Value::numbers(scene.obstacle->size)}});
    root.put("body",
             Value::list({Value::table({{"name", box},
                                        {"fixed", Value::flag(true)},
                                        {"shape", Value::table({{"box", shape}})},
                                        {"position", Value::numbers(scene.obstacle->position)}})}));
    const Value base = Value::of(study_robot.name() + "/" + link_of(1)), apart = Value::flag(false);
    // No contacts of the base, none between links.
    root.put("pair",
             Value::list({Value::table({{"a", name},
                                        {"b", box},
                                        {"friction", Value::of(settings.contact_friction)},
                                        {"stiffness", Value::of(settings.contact_stiffness)},
                                        {"dissipation", Value::of(settings.contact_dissipation)}}),
                          Value::table({{"a", base}, {"b", box}, {"collide", apart}}),
                          Value::table({{"a", name}, {"b", name}, {"collide", apart}})}));
  }

  void put_operator(Value& coupling) const {
    const DrivenJoints& joints = study_robot.joints();
    coupling.put("target", scene.hand.target);
    coupling.put("gripper", Value::table({{"joint", Value::of(joints.gripper)},
                                          {"open", Value::of(joints.gripper_open)},
                                          {"closed", Value::of(joints.gripper_closed)}}));
  }

  static void put_gains(Value& coupling, double stiffness, double damping) {
    coupling.put("stiffness", Value::of(stiffness));
    coupling.put("damping", Value::of(damping));
  }

  Value joint_coupling(const std::string& name, int body) const {
    return Value::table({{"name", Value::of(name)},
                         {"type", Value::of("torsional")},
                         {"measure", Value::of("joint")},
                         {"link", Value::of(link_of(body))}});
  }

  // The studied one, those of the other joints, and the stops of the gripper.
  Value couplings() const {
    Value all = Value::list({});
    const CouplingSpec& studied = scene.spec.coupling;
    for (const Spring& spring : study_robot.springs(scene.spec.gains)) {
      Value& coupling = all.items.emplace_back(
          Value::table({{"name", Value::of("pull_" + spring.name)},
                        {"type", Value::of(facts_of(studied.type, studied.printed).name)},
                        {"link", Value::of(link_of(spring.body))}}));
      if (studied.type == CouplingSpec::Type::linear)
        coupling.put("point", Value::numbers(spring.p_L));
      if (!studied.printed) coupling.put("discretization", Value::of(discretization_name(studied)));
      put_gains(coupling, spring.k, spring.b);
      put_operator(coupling);
    }
    for (const CouplingSpec& held : study_robot.auxiliary())
      for (const Spring& spring : held.springs) {
        Value& coupling =
            all.items.emplace_back(joint_coupling("hold_" + spring.name, spring.body));
        put_gains(coupling, spring.k, spring.b);
        put_operator(coupling);
      }
    for (const JointStops::Stop& stop : study_robot.stops()) {
      const std::string& joint = model.joint_name[static_cast<std::size_t>(stop.body)];
      Value& coupling = all.items.emplace_back(joint_coupling("stop_" + joint, stop.body));
      coupling.put("soft_limits", Value::numbers(std::array{stop.lower, stop.upper}));
      put_gains(coupling, stop.k, stop.b);
    }
    return all;
  }
};

}  // namespace

StudyOperator automatic_operator() {
  static const AutomaticMotion motion{OperatorMapping{}};
  return {Value::of("paper"), &motion};
}

StudyOperator device_operator() {
  static const DeviceMotion at_zero(1);
  return {Value::of("device"), &at_zero};
}

StudyOperator synthetic_study_operator(const OperatorMotion& source, unsigned seed,
                                       const SyntheticRanges& ranges) {
  return {Value::table({{"seed", Value::of(seed)},
                        {"duration", Value::of(source.duration())},
                        {"peak_speed", Value::numbers(ranges.peak_speed)},
                        {"tremor", Value::numbers(ranges.tremor)}}),
          &source};
}

StudyOperator traced_operator(const OperatorMotion& source, const std::filesystem::path& trace) {
  return {Value::of(std::filesystem::absolute(trace).lexically_normal().string()), &source};
}

std::string scene_text(const StudyScene& scene) {
  return SceneWriter{scene}.text();
}

}  // namespace twinarm
