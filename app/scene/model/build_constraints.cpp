// Constraints, from names to bodies of the model.
#include "app/scene/model/scene_builder.h"
#include "solver/dynamics/kinematics.h"
#include "solver/spatial/rotation_to_axis.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

class ConstraintBuilder {
 public:
  explicit ConstraintBuilder(SceneModel& scene) : scene_(scene), k_(scene.model) {
    forward_kinematics(scene.model, scene.start, k_);
  }

  void build() {
    for (const ConstraintDescription& given : scene_.description.constraints) {
      SceneConstraint made;
      made.name = given.name;
      made.line = given.line;
      made.type = given.type;
      if (given.type == ConstraintDescription::Type::gear)
        build_gear(given, made);
      else
        build_joint(given, made);
      scene_.constraints.push_back(std::move(made));
    }
    faults_.check();
  }

 private:
  // Of the body that is meant, in the world; a fixed one has no body of its own in the model.
  Vector3 origin_of(const std::string& name) const {
    const SceneReference who = *find_reference(scene_.description, name);
    if (who.body >= 0) {
      const BodyDescription& body = scene_.description.bodies[static_cast<std::size_t>(who.body)];
      if (body.fixed) return body.X_WB.p;
    }
    return k_.X_WL[static_cast<std::size_t>(body_of(scene_, who))].p;
  }

  // The ends of a distance in the world. One point belongs to the one of the two that is fixed,
  // else to a; the other end is then the origin of the other body.
  std::pair<Vector3, Vector3> ends(const ConstraintDescription& given,
                                   const SceneConstraint& made) const {
    const Vector3 origin_a = origin_of(given.a), origin_b = origin_of(given.b);
    if (given.point && !given.point_b && made.b == 0) return {origin_a, *given.point};
    return {given.point.value_or(origin_a), given.point_b.value_or(origin_b)};
  }

  void fault(const SceneConstraint& made, std::string rule, std::string remedy,
             std::string_view code) {
    faults_.add({scene_.description.file.string(), made.line, "constraint '" + made.name + "'",
                 std::move(rule), std::move(remedy), code});
  }

  void build_gear(const ConstraintDescription& given, SceneConstraint& made) {
    const auto body_and_velocity = [&](const std::string& name) {
      const JointReference joint = *find_joint(scene_.description, name);
      const int body = scene_.model.find_joint(
          name_in_scene(scene_.description, joint.robot, joint.joint->name));
      return std::pair{body, scene_.model.iv[static_cast<std::size_t>(body)]};
    };
    std::tie(made.a, made.iv_a) = body_and_velocity(given.a);
    std::tie(made.b, made.iv_b) = body_and_velocity(given.b);
    made.ratio = given.ratio;
    const auto q = [&](int body) {
      return scene_.start.q[scene_.model.iq[static_cast<std::size_t>(body)]];
    };
    made.offset = q(made.a) - made.ratio * q(made.b);
  }

  void build_joint(const ConstraintDescription& given, SceneConstraint& made) {
    made.a = body_of(scene_, *find_reference(scene_.description, given.a));
    made.b = body_of(scene_, *find_reference(scene_.description, given.b));
    const Pose& X_WA = k_.X_WL[static_cast<std::size_t>(made.a)];
    const Pose& X_WB = k_.X_WL[static_cast<std::size_t>(made.b)];
    if (made.a == made.b)
      fault(made, "both are the same body", "name two that can move", "scene.same-ends");
    if (given.type == ConstraintDescription::Type::distance) {
      const auto [p_WA, p_WB] = ends(given, made);
      made.X_AC = X_WA.inverse() * Pose{Matrix3::Identity(), p_WA};
      made.X_BC = X_WB.inverse() * Pose{Matrix3::Identity(), p_WB};
      made.length = (p_WB - p_WA).norm();
      if (!(made.length > 0))
        fault(made, "its two ends are the same point", "give another point", "scene.same-ends");
      return;
    }
    Pose X_WC;
    X_WC.p = given.point.value_or(X_WA.p);
    if (given.axis) X_WC.R = turn_z_to(*given.axis);
    made.X_AC = X_WA.inverse() * X_WC;
    made.X_BC = X_WB.inverse() * X_WC;
  }

  SceneModel& scene_;
  Kinematics k_;
  FaultList faults_;
};

}  // namespace

void build_constraints(SceneModel& scene) {
  ConstraintBuilder(scene).build();
}

}  // namespace twinarm
