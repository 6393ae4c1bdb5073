#include "app/robot/robot_input.h"

#include <fmt/format.h>

#include "collision/import/formats/robot_formats.h"
#include "collision/import/robot/robot_model.h"
#include "solver/dynamics/kinematics.h"
#include "solver/model/mimic.h"

namespace twinarm {
namespace {

// Names the options that give inertia where it is missing.
template <class F>
auto with_remedy(F f) try {
  return f();
} catch (const InputError& error) {
  throw error.changed([](Diagnostic& fault) {
    for (const char* code : {"model.no-inertia", "urdf.inertia-missing", "urdf.mass-missing"})
      if (fault.code == code)
        fault.fix += "; or give --density 1000 (of its shapes), or --min-mass 0.001";
  });
}

std::optional<RobotDescription> read_model_file(const RobotOptions& options,
                                                DiagnosticList& faults) {
  const std::filesystem::path& file = options.model;
  const auto fault = [&](const char* problem, const char* fix, std::string_view code) {
    faults.add({file.string(), 0, "model", problem, fix, code});
    return std::nullopt;
  };
  std::error_code ignored;
  if (file.extension() == ".toml")
    return fault("is a scene", "give a robot's URDF, or run the scene with `twinarm simulate`",
                 "file.is-scene");
  if (file.extension() == ".twinrec")
    return fault("is a recording",
                 "give a robot's URDF; `twinarm inspect` and `twinarm replay` open recordings",
                 "file.is-recording");
  if (std::filesystem::is_directory(file, ignored))
    return fault("is a folder", "name the robot's URDF in it", "file.is-folder");
  return attempt(faults, [&] {
    RobotDescription robot = with_remedy([&] {
      return read_robot_file(file,
                             {.geometry = RobotFileOptions::Geometry::optional,
                              .strict = options.strict,
                              .incomplete_inertia = options.kinematic || options.missing.any(),
                              .roots = options.roots});
    });
    add_missing_inertia(robot, options.missing);
    return robot;
  });
}

struct StateReader {
  const std::string file_;
  const RobotDescription& robot_;
  const Model<double>& model_;
  const Coordinates& coordinates_;
  DiagnosticList& faults_;
  GivenState state_;

  GivenState read(const Value& json) {
    if (!json.is_table()) {
      faults_.add({file_, json.line, "the state", "must be an object, is " + describe(json),
                   "write {\"name\": value}", "scene.type"});
      return state_;
    }
    TableReader state(json, {"the state", "", ""}, file_, faults_);
    // Orientations first: they rotate velocities and forces of a floating joint.
    each_joint(state, "q", JointRows::coordinates, [&](const NamedJoint& joint, const Numbers& q) {
      std::ranges::copy(q, state_.x.q.data() + joint.iq);
    });
    each_joint(state, "qd", JointRows::velocities, [&](const NamedJoint& joint, const Numbers& qd) {
      to_solver(joint, state_.x, qd.data(), state_.x.qd);
    });
    each_joint(state, "qdd", JointRows::velocities,
               [&](const NamedJoint& joint, const Numbers& v) { set_rows(joint, v, state_.qdd); });
    each_joint(state, "tau", JointRows::velocities, [&](const NamedJoint& joint, const Numbers& v) {
      set_rows(joint, v, state_.tau);
      state_.has_tau[static_cast<std::size_t>(&joint - coordinates_.all().data())] = true;
    });
    read_base(state);
    read_wrenches(state);
    state.done();
    apply_mimics(model_, state_.x);
    return state_;
  }

 private:
  using Numbers = std::vector<double>;

  // Calls take(joint, numbers) for every valid entry of the object under `key`.
  template <class Take>
  void each_joint(TableReader& state, const std::string& key, JointRows rows, Take take) {
    const Value* object = state.table(key);
    if (!object) return;
    TableReader joints(*object, {key, key + " of joint '", "'"}, file_, faults_);
    for (const auto& [name, given] : read_joint_values(joints, robot_, rows, &state_.warnings))
      take(*coordinates_.find(name), given.values);
  }
  static void set_rows(const NamedJoint& joint, const Numbers& values, Eigen::VectorXd& rows) {
    for (std::size_t k = 0; k < joint.nv; ++k)
      rows[static_cast<Eigen::Index>(joint.row + k)] = values[k];
  }

  void read_base(TableReader& state) {
    const Value* object = state.table("base");
    if (!object) return;
    if (!coordinates_.floating())
      return state.fault("base", "the base is fixed", "give --floating, or leave 'base' out",
                         "scene.key-useless");
    TableReader base(*object, {"base", "base.", ""}, file_, faults_);
    double* q = state_.x.q.data() + coordinates_.base().iq;
    if (const auto p = base.vector("position")) std::copy(p->begin(), p->end(), q);
    if (const auto orientation = base.numbers("orientation", 4)) {
      std::ranges::copy(*orientation, q + 3);
      normalise(base, "orientation", std::span<double, 4>(q + 3, 4), &state_.warnings);
    }
    const auto motion = [&](const char* linear, const char* angular) {
      const Vector3 v = base.vector(linear).value_or(Vector3::Zero());
      const Vector3 w = base.vector(angular).value_or(Vector3::Zero());
      return (Eigen::Matrix<double, 6, 1>() << v, w).finished();
    };
    const auto velocity = motion("linear_velocity", "angular_velocity");
    to_solver(coordinates_.base(), state_.x, velocity.data(), state_.x.qd);
    state_.qdd.head<6>() = motion("linear_acceleration", "angular_acceleration");
    base.done();
  }

  void read_wrenches(TableReader& state) {
    const Value* list = state.find("wrenches");
    if (!list) return;
    if (!list->is_list())
      return state.fault("wrenches", "must be a list, is " + describe(*list),
                         "write [{\"link\": .., \"force\": [..]}]", "scene.type");
    for (std::size_t i = 0; i < list->items.size(); ++i)
      read_wrench(list->items[i], fmt::format("wrenches[{}]", i));
  }
  void read_wrench(const Value& json, const std::string& where) {
    TableReader given(json, {where, where + ".", ""}, file_, faults_);
    if (!json.is_table())
      return given.fault("", "must be an object, is " + describe(json), "write {\"name\": value}",
                         "scene.type");
    Wrench wrench;
    const Value* link = given.find("link");
    if (!link || !link->is_text())
      given.fault("link", "is missing", "give \"link\": \"NAME\"", "scene.missing");
    else if (const auto body = find_link(link->text))
      wrench.body = *body;
    else
      given.fault("link", "there is no link '" + link->text + "'",
                  name_remedy(link->text, link_names(), "links"), "scene.unknown-name");
    wrench.in_link_axes = given.choice("frame", {"world", "link"}).value_or(0) == 1;
    wrench.point = given.vector("point").value_or(Vector3::Zero());
    wrench.force = given.vector("force").value_or(Vector3::Zero());
    wrench.torque = given.vector("torque").value_or(Vector3::Zero());
    given.done();
    state_.wrenches.push_back(wrench);
  }
  // Unlike find_body() without the world.
  std::optional<std::size_t> find_link(const std::string& name) const {
    const auto found = std::find(model_.body_name.begin() + 1, model_.body_name.end(), name);
    if (found == model_.body_name.end()) return std::nullopt;
    return static_cast<std::size_t>(found - model_.body_name.begin());
  }
  std::vector<std::string> link_names() const {
    return {model_.body_name.begin() + 1, model_.body_name.end()};
  }
};

}  // namespace

std::vector<double> parse_list(const std::string& option, const std::string& text,
                               DiagnosticList& faults) {
  std::vector<double> values;
  for (std::string item : split(text)) {
    item.erase(0, item.find_first_not_of(' '));
    item.erase(item.find_last_not_of(' ') + 1);
    if (const auto value = parse_number(item)) {
      values.push_back(*value);
    } else {
      faults.add(option, "'" + item + "' is not a finite number",
                 "write numbers separated by commas", "option.number");
      return {};
    }
  }
  return values;
}

bool check_positive(const std::string& option, double value, DiagnosticList& faults,
                    const char* unit) {
  if (value > 0 && std::isfinite(value)) return true;
  faults.add(option, fmt::format("must be positive{}, is {}", unit, number_text(value)), "",
             "option.not-positive");
  return false;
}

std::optional<Vector3> parse_gravity(const std::string& text, DiagnosticList& faults) {
  const std::vector<double> numbers = parse_list("--gravity", text, faults);
  if (numbers.size() == 3) return Vector3(numbers.data());
  if (!numbers.empty())
    faults.add("--gravity", "has " + std::to_string(numbers.size()) + " numbers",
               "give three: --gravity 0,0,-9.81", "option.count");
  return std::nullopt;
}

void check_dense(const Model<double>& model, const std::filesystem::path& file) {
  if (model.nv <= kMaxDense) return;
  throw InputError(
      {{file.string(), 0, "",
        fmt::format("has {} degrees of freedom: more than {}, up to which dense matrices are "
                    "computed",
                    model.nv, kMaxDense),
        "give a part of it; `twinarm simulate` and `dynamics` take O(n)", "model.too-large"}});
}

void add_gravity_warning(const Model<double>& model, std::vector<std::string>& warnings) {
  if (model.gravity.z > 0)
    warnings.push_back(fmt::format("gravity points up: its z is {:g} m/s^2; on Earth it is -9.81",
                                   model.gravity.z));
}

RobotInput read_robot_input(const RobotOptions& options, DiagnosticList faults) {
  if (!options.changes.empty())
    faults.add("--set", "applies to a scene only", "leave it out, or give a scene",
               "option.useless");
  std::optional<Vector3> gravity;
  if (!options.gravity.empty()) gravity = parse_gravity(options.gravity, faults);
  std::optional<Value> json;
  if (!options.state.empty()) json = attempt(faults, [&] { return read_json(options.state); });
  const auto robot = read_model_file(options, faults);
  if (!robot) faults.check();

  ModelOptions model_options;
  model_options.floating = options.floating;
  model_options.friction = options.friction;
  model_options.armature = options.armature;
  model_options.kinematic = options.kinematic;
  auto model = attempt(
      faults, [&] { return with_remedy([&] { return build_model(*robot, model_options); }); });
  if (!model) faults.check();
  if (gravity) model->gravity = from_eigen(*gravity);

  const Coordinates coordinates(*model, options.floating);
  GivenState state = default_state(*model, coordinates);
  if (json) state = read_state(*json, options.state, *robot, *model, coordinates, state, faults);
  faults.check();
  std::vector<std::string> warnings;
  for (const Diagnostic& warning : robot->warnings) warnings.push_back(to_string(warning));
  warnings.insert(warnings.end(), state.warnings.begin(), state.warnings.end());
  add_gravity_warning(*model, warnings);
  return {*robot, std::move(*model), coordinates, std::move(state), std::move(warnings)};
}

GivenState default_state(const Model<double>& model, const Coordinates& coordinates) {
  GivenState state;
  state.x = State<double>(model);
  apply_mimics(model, state.x);
  state.tau = state.qdd = Eigen::VectorXd::Zero(coordinates.rows());
  state.has_tau.assign(coordinates.all().size(), false);
  return state;
}

GivenState read_state(const Value& json, const std::filesystem::path& file,
                      const RobotDescription& robot, const Model<double>& model,
                      const Coordinates& coordinates, const GivenState& start,
                      DiagnosticList& faults) {
  return StateReader{file.string(), robot, model, coordinates, faults, start}.read(json);
}

}  // namespace twinarm
