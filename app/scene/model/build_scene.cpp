// Builds one model of all robots and bodies, and the start state.

#include "app/scene/model/scene_builder.h"
#include "solver/model/mimic.h"

namespace twinarm {
namespace {

std::string prefix_of(const SceneDescription& scene, std::size_t robot) {
  return name_in_scene(scene, robot, "");
}

BodyInertia inertia_of(const BodyDescription& body) {
  const bool is_given = body.inertia && body.com && body.mass;
  MassProperties solid;
  if (!is_given) solid = mass_properties(collision_shape(body.shape), body.density.value_or(1));
  const double mass = body.mass.value_or(solid.mass);
  return {mass, body.com.value_or(solid.com),
          body.inertia ? *body.inertia : Matrix3(solid.inertia * (mass / solid.mass))};
}

constexpr double kWideMesh = 10;  // [m]; a wider mesh is probably in millimetres

// Checks a mesh. The surface of a convex one need not be closed: its hull is used.
void check_mesh(const BodyDescription& body, SceneDescription& scene) {
  const auto* file = std::get_if<MeshGeometry>(&body.shape);
  if (!file) return;
  TriangleMesh mesh = load_mesh(*file);
  const double width = bounding_box(mesh.vertices).sizes().maxCoeff();
  if (width > kWideMesh)
    scene.warnings.push_back(scene.file.string() + ":" + std::to_string(body.line) + ": body '" +
                             body.name + "': its mesh is " + short_number_text(width) +
                             " m wide; if the file is in millimetres, give scale = 0.001");
  if (file->convex) {
    collision_shape(body.shape);  // throws if it has no volume
    return;
  }
  const std::string fault = MeshShape{std::move(mesh)}.fault();
  if (!fault.empty())
    throw InputError("", "mesh '" + file->name + "': " + fault,
                     "repair the mesh, or give convex = true to use its hull", "scene.mesh");
}

MotionFunction law_of(const Pose& X_WB, const BodyMotion& motion) {
  const bool swings = !motion.swing.isZero(0);
  const Vector3 turn = swings ? motion.swing : motion.angular;
  const Vector3 axis = turn.isZero(0) ? Vector3(Vector3::UnitZ()) : turn.normalized();
  const double w = 2 * std::numbers::pi * motion.frequency;
  return [=](double t) {
    const double s = std::sin(w * t), ds = w * std::cos(w * t), dds = -w * w * s;
    PrescribedMotion now;
    now.X_JL.p = X_WB.p + t * motion.linear;
    now.X_JL.R =
        Eigen::AngleAxisd((swings ? s : t) * turn.norm(), axis).toRotationMatrix() * X_WB.R;
    now.velocity = motion.linear;
    now.angular_velocity = motion.angular;
    if (w == 0) return now;
    now.X_JL.p += s * motion.amplitude;
    now.velocity += ds * motion.amplitude;
    now.acceleration = dds * motion.amplitude;
    now.angular_velocity += ds * motion.swing;
    now.angular_acceleration = dds * motion.swing;
    return now;
  };
}

class SceneBuilder {
 public:
  SceneBuilder(const SceneDescription& description, const ModelOptions& options)
      : options_(options) {
    scene_.description = description;
  }

  SceneModel build() {
    builder_.set_gravity(description().gravity);
    add_robots();
    add_bodies();
    faults_.check();
    build_model();
    scene_.start = State<double>(scene_.model);
    place_robots();
    place_bodies();
    start_motions();
    apply_mimics(scene_.model, scene_.start);
    build_couplings(scene_);
    build_constraints(scene_);
    build_geometries(scene_);
    return std::move(scene_);
  }

 private:
  const SceneDescription& description() const { return scene_.description; }

  template <class F>
  void attempt(int line, const std::string& where, F f) {
    try {
      f();
    } catch (const InputError& error) {
      for (Diagnostic fault : error.faults()) {
        if (fault.file.empty()) {
          fault.file = description().file.string();
          fault.line = line;
          fault.where = where;
        }
        faults_.add(fault);
      }
    }
  }

  void add_robots() {
    for (std::size_t r = 0; r < description().robots.size(); ++r) {
      const RobotInScene& robot = description().robots[r];
      ModelOptions options = options_;
      options.floating = robot.floating;
      options.driven = robot.motion.has_value();
      options.mass_scale = robot.mass_scale;
      options.added_masses = robot.payloads;
      attempt(robot.line, "robot '" + robot.name + "'", [&] {
        add_robot(builder_, robot.description, options, prefix_of(description(), r), robot.X_WR);
      });
      scene_.robot_bodies += static_cast<int>(robot.description.links.size());
    }
  }

  void add_bodies() {
    for (const BodyDescription& body : description().bodies) {
      bool sound = false;
      attempt(body.line, "body '" + body.name + "'", [&] {
        check_mesh(body, scene_.description);
        sound = true;
      });
      if (body.fixed || !sound) continue;
      BodyInertia inertia;  // not used for a prescribed motion
      if (body.is_free())
        attempt(body.line, "body '" + body.name + "'", [&] { inertia = inertia_of(body); });
      builder_.add_body(body.name, 0, free_joint_name(body.name),
                        body.motion ? JointType::prescribed : JointType::free, {}, Vector3::UnitZ(),
                        inertia);
    }
  }

  // The name of the body, made unique among the joints of the robots.
  std::string free_joint_name(std::string name) const {
    while (find_joint(description(), name)) name += "_";
    return name;
  }

  // Moves a diagnostic of robot r to its line in the robot's file; of its root joint, in the scene.
  void locate(std::size_t r, Diagnostic& fault) const {
    const RobotInScene& robot = description().robots[r];
    const std::string prefix = prefix_of(description(), r);
    if (fault.where == joint_called(prefix + root_joint_name(robot.description, robot.floating)))
      fault.line = robot.line;
    const auto move_to = [&](int line) {
      fault.file = robot.description.file.string();
      fault.line = line;
    };
    for (const LinkDescription& link : robot.description.links)
      if (fault.where == link_called(prefix + link.name)) move_to(link.line);
    for (const JointDescription& joint : robot.description.joints)
      if (fault.where == joint_called(prefix + joint.name)) move_to(joint.line);
  }

  void build_model() {
    try {
      scene_.model = builder_.build();
    } catch (const InputError& error) {
      throw error.changed([&](Diagnostic& fault) {
        fault.file = description().file.string();
        for (std::size_t r = 0; r < description().robots.size(); ++r) locate(r, fault);
        for (const BodyDescription& body : description().bodies)
          if (fault.where == link_called(body.name) ||
              fault.where == joint_called(free_joint_name(body.name)))
            fault.line = body.line;
      });
    }
  }

  void place_robots() {
    for (std::size_t r = 0; r < description().robots.size(); ++r) {
      const RobotInScene& robot = description().robots[r];
      set_coordinates(scene_, r, robot.q, scene_.start);
      set_velocities(scene_, r, robot.qd, scene_.start);
      const int root = scene_.model.find_body(prefix_of(description(), r) + robot.description.root);
      if (robot.floating) place(root, robot.X_WR, robot.linear_velocity, robot.angular_velocity);
      if (robot.motion) drive(root, robot.X_WR, *robot.motion);
    }
  }

  void drive(int body, const Pose& X_WB, const BodyMotion& motion) {
    scene_.motions.push_back({body, law_of(X_WB, motion)});
    store_motion(scene_.model, static_cast<std::size_t>(body), scene_.motions.back().law(0),
                 scene_.start);
  }

  void start_motions() {
    for (const ConstraintDescription& c : description().constraints) {
      if (!c.motion) continue;
      const auto body = static_cast<std::size_t>(child_of(scene_, c.a));
      ExpressionTape motion = *c.motion;
      const auto start = motion(std::array{0.0});
      scene_.start.q[scene_.model.iq[body]] = start[0];
      scene_.start.qd[scene_.model.iv[body]] = start[1];
    }
  }

  void place_bodies() {
    for (const BodyDescription& body : description().bodies) {
      if (body.fixed) continue;
      const int index = scene_.model.find_body(body.name);
      if (body.is_free()) {
        place(index, body.X_WB, body.linear_velocity, body.angular_velocity);
        continue;
      }
      drive(index, body.X_WB, *body.motion);
    }
  }

  // State of a free joint; its angular velocity is in body axes (solver/model/joints.h).
  void place(int body, const Pose& X_WB, const Vector3& v_W, const Vector3& w_W) {
    const auto i = static_cast<std::size_t>(body);
    double* q = scene_.start.q.data() + scene_.model.iq[i];
    double* qd = scene_.start.qd.data() + scene_.model.iv[i];
    const Eigen::Quaterniond rotation(X_WB.R);
    const Vector3 w_B = X_WB.R.transpose() * w_W;
    Eigen::Map<Eigen::Vector<double, 7>>(q) << X_WB.p, rotation.w(), rotation.vec();
    Eigen::Map<Eigen::Vector<double, 6>>(qd) << w_B, v_W;
  }

  ModelOptions options_;
  SceneModel scene_;
  ModelBuilder builder_;
  DiagnosticList faults_;
};

// The reader has checked that there is one.
NamedJoint joint_in_model(const SceneModel& scene, std::size_t robot, const std::string& name) {
  const Model<double>& model = scene.model;
  const auto i =
      static_cast<std::size_t>(model.find_joint(prefix_of(scene.description, robot) + name));
  const JointType type = model.joint[i];
  return {name, i, type, facts_of(type).nq, model.dofs(i), model.iq[i], model.iv[i], 0};
}

}  // namespace

void set_coordinates(const SceneModel& scene, std::size_t robot, const JointValueMap& q,
                     State<double>& x) {
  for (const auto& [name, given] : q)
    std::ranges::copy(given.values, x.q.data() + joint_in_model(scene, robot, name).iq);
}

void set_velocities(const SceneModel& scene, std::size_t robot, const JointValueMap& qd,
                    State<double>& x) {
  for (const auto& [name, given] : qd)
    to_solver(joint_in_model(scene, robot, name), x, given.values.data(), x.qd);
}

int child_of(const SceneModel& scene, const std::string& name) {
  const JointReference joint = *find_joint(scene.description, name);
  return scene.model.find_joint(name_in_scene(scene.description, joint.robot, joint.joint->name));
}

int body_of(const SceneModel& scene, const SceneReference& reference) {
  const SceneDescription& description = scene.description;
  if (reference.robot >= 0) {
    const auto robot = static_cast<std::size_t>(reference.robot);
    return scene.model.find_body(prefix_of(description, robot) + reference.link);
  }
  if (reference.is_world()) return 0;
  const BodyDescription& body = description.bodies[static_cast<std::size_t>(reference.body)];
  return body.fixed ? 0 : scene.model.find_body(body.name);
}

std::pair<int, int> SceneModel::bodies_of_robot(std::size_t robot) const {
  const auto links = [&](std::size_t r) {
    return static_cast<int>(description.robots[r].description.links.size());
  };
  int first = 1;
  for (std::size_t r = 0; r < robot; ++r) first += links(r);
  return {first, first + links(robot) - 1};
}

Vector3 com_of_link(const Model<double>& model, std::size_t body) {
  const Inertia<double> I = model.I[body];
  if (!(I.m > 0)) return Vector3::Zero();
  return to_eigen(model.R_BL[body]).transpose() * to_eigen(I.h) / I.m;
}

SceneModel build_scene(const SceneDescription& description, const ModelOptions& options) {
  return SceneBuilder(description, options).build();
}

}  // namespace twinarm
