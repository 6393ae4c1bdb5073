#include "app/lab/run/lab_scene.h"

#include "app/scene/read/read_scene.h"
#include "app/support/text.h"
#include "solver/dynamics/dynamics.h"

namespace twinarm {
namespace {

constexpr double kOmega = 30;  // natural frequency of added springs, critically damped [rad/s]

[[noreturn]] void refuse(const SceneEdit& edit, const std::string& problem,
                         const std::string& fix) {
  throw InputError({{"command", 0, "edit, " + edit.what, problem, fix, "lab.edit"}});
}

void append(Value& scene, const char* key, Value item) {
  Value* list = scene.find(key);
  if (!list) list = &scene.put(key, Value::list({}));
  list->items.push_back(std::move(item));
}

// Three significant digits are enough for values that a person would have typed.
double rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 2);
  return std::round(value / unit) * unit;
}

// Of everything that moves at the start, and of bounded obstacles.
Eigen::AlignedBox3d bounds_of(const SceneModel& scene) {
  const Kinematics k = kinematics_at(scene.model, scene.start);
  Eigen::AlignedBox3d bounds;
  for (int body = 1; body < scene.model.body_count(); ++body)
    bounds.extend(k.X_WL[static_cast<std::size_t>(body)].p);
  for (const SceneGeometry& geometry : scene.geometries) {
    if (std::holds_alternative<HalfSpace>(geometry.shape)) continue;
    const Pose X_WG = k.X_WL[static_cast<std::size_t>(geometry.body)] * geometry.X_LG;
    const Shape shape = collision_shape(geometry.shape);
    for (int axis = 0; axis < 3; ++axis)
      for (const double way : {-1.0, 1.0}) {
        const Vector3 d_W = way * Vector3::Unit(axis);
        bounds.extend(X_WG * support(shape, X_WG.R.transpose() * d_W));
      }
  }
  if (bounds.isEmpty()) bounds.extend(Vector3(Vector3::Zero()));
  return bounds;
}

std::string unused_name(const SceneModel& scene, const std::string& kind) {
  std::set<std::string> used(scene.model.body_name.begin(), scene.model.body_name.end());
  for (const BodyDescription& body : scene.description.bodies) used.insert(body.name);
  std::string name = kind;
  for (int n = 2; used.contains(name); ++n) name = kind + std::to_string(n);
  return name;
}

void add_floor(const SceneEdit& edit, const SceneModel& built, Value& scene) {
  for (const BodyDescription& body : built.description.bodies)
    if (std::holds_alternative<HalfSpace>(body.shape))
      refuse(edit, "'" + body.name + "' is a floor already", "remove it first");
  const double z = std::floor(1000 * bounds_of(built).min().z()) / 1000;
  const Value half_space = Value::table(
      {{"normal", Value::numbers(Vector3(Vector3::UnitZ()))}, {"offset", Value::of(z)}});
  append(scene, "body",
         Value::table({{"name", Value::of(unused_name(built, "floor"))},
                       {"fixed", Value::flag(true)},
                       {"shape", Value::table({{"halfspace", half_space}})}}));
}

// A tenth of the scene's size, a quarter of it above everything, of half the density of water.
void add_object(const SceneEdit& edit, const SceneModel& built, Value& scene) {
  const Eigen::AlignedBox3d bounds = bounds_of(built);
  const double size = std::clamp(rounded(bounds.diagonal().norm()), 0.1, 10.0);
  const double edge = rounded(size / 10);
  Vector3 p = bounds.center();
  p.z() = bounds.max().z() + edge + 0.25 * size;
  for (double& c : p) c = std::round(1000 * c) / 1000;
  const Value shape = edit.what == "box"
                          ? Value::table({{"size", Value::numbers(std::array{edge, edge, edge})}})
                          : Value::table({{"radius", Value::of(edge / 2)}});
  append(scene, "body",
         Value::table({{"name", Value::of(unused_name(built, edit.what))},
                       {"shape", Value::table({{edit.what.c_str(), shape}})},
                       {"density", Value::of(500.0)},
                       {"position", Value::numbers(p)}}));
}

// Of the link's robot and of the link, by its number in the model.
std::pair<const RobotInScene*, std::string> owner_of(const SceneModel& scene, int body) {
  const auto& robots = scene.description.robots;
  for (std::size_t r = 0; r < robots.size(); ++r)
    if (const auto [first, last] = scene.bodies_of_robot(r); body >= first && body <= last) {
      const std::string& name = scene.model.body_name[static_cast<std::size_t>(body)];
      return {&robots[r], name.substr(name_in_scene(scene.description, r, "").size())};
    }
  return {nullptr, ""};
}

void add_spring(const SceneModel& built, int body, bool is_linear, double inertia, Value& scene) {
  const auto [robot, link] = owner_of(built, body);
  std::string name = link + " spring";
  for (const CouplingDescription& coupling : built.description.couplings)
    if (coupling.name == name) name += "'";
  Value coupling = Value::table({{"name", Value::of(name)},
                                 {"type", Value::of(is_linear ? "linear" : "torsional")},
                                 {"link", Value::of(link)},
                                 {"stiffness", Value::of(rounded(inertia * kOmega * kOmega))},
                                 {"damping", Value::of(rounded(2 * inertia * kOmega))}});
  if (built.description.robots.size() > 1) coupling.put("robot", Value::of(robot->name));
  if (is_linear) {
    const Vector3 com = com_of_link(built.model, static_cast<std::size_t>(body));
    const auto to_tenth_mm = [](double c) { return std::round(1e4 * c) / 1e4; };
    coupling.put("point", Value::numbers(Vector3(com.unaryExpr(to_tenth_mm))));
  } else {
    coupling.put("measure", Value::of("joint"));
  }
  append(scene, "coupling", std::move(coupling));
}

void add_springs(const SceneEdit& edit, const SceneModel& built, Value& scene) {
  const Model<double>& model = built.model;
  if (edit.what == "link-spring") {
    const int body = model.find_body(edit.name);
    if (body <= 0 || !owner_of(built, body).first)
      refuse(edit, "'" + edit.name + "' is no link of a robot", "select a link of a robot first");
    double mass = 0;  // of all links: what the spring moves at most
    for (int b = 1; b <= built.robot_bodies; ++b)
      if (owner_of(built, b).first == owner_of(built, body).first)
        mass += model.I[static_cast<std::size_t>(b)].m;
    return add_spring(built, body, true, mass, scene);
  }
  const Eigen::MatrixXd M = mass_matrix(model, built.start);
  std::size_t added = 0;
  for (int body = 1; body <= built.robot_bodies; ++body) {
    const auto [robot, link] = owner_of(built, body);
    const JointDescription* joint = own_joint(robot->description, link);
    if (!joint || joint->dofs() != 1 || joint->mimic) continue;
    const auto row = static_cast<Eigen::Index>(model.iv[static_cast<std::size_t>(body)]);
    add_spring(built, body, false, M(row, row), scene);
    ++added;
  }
  if (added == 0) refuse(edit, "no robot has a joint of one degree of freedom", "open a robot");
}

void remove_body(const SceneEdit& edit, const SceneModel& built, Value& scene) {
  Value* bodies = scene.find("body");
  const auto is_it = [&](const Value& body) {
    const Value* name = body.find("name");
    return name && name->text == edit.name;
  };
  if (!bodies || std::erase_if(bodies->items, is_it) == 0)
    refuse(edit, "there is no body '" + edit.name + "'",
           name_remedy(edit.name, names_of(built.description.bodies), "bodies"));
  for (Value& list : scene.members)
    if (list.key == "pair" || list.key == "constraint")
      std::erase_if(list.items, [&](const Value& item) {
        return std::ranges::any_of(item.members, [&](const Value& member) {
          return (member.key == "a" || member.key == "b") && member.text == edit.name;
        });
      });
  std::erase_if(scene.members,
                [](const Value& list) { return list.is_list() && list.items.empty(); });
}

}  // namespace

Value scene_of_robot(const std::filesystem::path& robot, bool collide) {
  const Value name = Value::of(robot.stem().string());
  const Value table = Value::table({{"name", name},
                                    {"model", Value::of(robot.filename().string())},
                                    {"collide", Value::flag(collide)}});
  Value scene = Value::table({{"robot", Value::list({table})}});
  if (collide)
    append(scene, "pair",
           Value::table({{"a", name}, {"b", name}, {"collide", Value::flag(false)}}));
  return scene;
}

void apply(const SceneEdit& edit, const SceneModel& built, Value& scene) {
  if (edit.what == "floor")
    add_floor(edit, built, scene);
  else if (edit.what == "box" || edit.what == "sphere")
    add_object(edit, built, scene);
  else if (edit.what == "remove")
    remove_body(edit, built, scene);
  else
    add_springs(edit, built, scene);
}

}  // namespace twinarm
