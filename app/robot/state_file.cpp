#include "app/robot/state_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "app/support/nearest_name.h"
#include "solver/model/mimic.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

class StateReader {
 public:
  StateReader(const std::filesystem::path& file, const RobotDescription& robot,
              const Model<double>& model, const Coordinates& coordinates, const GivenState& start,
              FaultList& faults)
      : file_(file.string()),
        robot_(robot),
        model_(model),
        coordinates_(coordinates),
        faults_(faults),
        state_(start) {}

  GivenState read(const JsonValue& json) {
    if (!is_object(json, "the state")) return state_;
    check_keys(json, "", {"q", "qd", "tau", "qdd", "base", "wrenches"});
    // Orientations first: velocities and forces of a floating joint are turned by them.
    const auto coordinate = [](const NamedJoint& joint) { return joint.nq; };
    const auto velocity = [](const NamedJoint& joint) { return joint.nv; };
    each_joint(json, "q", coordinate, [&](const NamedJoint& joint, const Numbers& values) {
      set_coordinates(joint, values, json.find("q")->find(joint.name)->line);
    });
    read_base_pose(json);
    each_joint(json, "qd", velocity, [&](const NamedJoint& joint, const Numbers& values) {
      to_solver(joint, state_.x, values.data(), state_.x.qd);
    });
    each_joint(json, "qdd", velocity, [&](const NamedJoint& joint, const Numbers& values) {
      set_rows(joint, values, state_.qdd);
    });
    each_joint(json, "tau", velocity, [&](const NamedJoint& joint, const Numbers& values) {
      set_rows(joint, values, state_.tau);
      state_.has_tau[static_cast<std::size_t>(&joint - coordinates_.all().data())] = true;
    });
    read_base_motion(json);
    read_wrenches(json);
    apply_mimics(model_, state_.x);
    return state_;
  }

 private:
  using Numbers = std::vector<double>;

  void fault(int line, std::string where, std::string rule, std::string remedy) {
    faults_.add({file_, line, std::move(where), std::move(rule), std::move(remedy)});
  }

  bool is_object(const JsonValue& value, const std::string& where) {
    if (value.kind == JsonValue::Kind::object) return true;
    fault(value.line, where, "must be an object, is " + describe(value), "write {\"name\": value}");
    return false;
  }
  void check_keys(const JsonValue& object, const std::string& where,
                  const std::vector<std::string>& known) {
    for (const JsonValue& member : object.members)
      if (std::ranges::find(known, member.key) == known.end())
        fault(member.line, where + member.key, "is not known here",
              name_remedy(member.key, known, "keys"));
  }
  // Nothing where the value is not that; the fault is told.
  std::optional<Numbers> numbers(const JsonValue& value, std::size_t count,
                                 const std::string& where) {
    const std::string wanted = count == 1 ? "a number" : fmt::format("a list of {} numbers", count);
    const auto is_number = [](const JsonValue& item) {
      return item.kind == JsonValue::Kind::number && std::isfinite(item.number);
    };
    if (count == 1) {
      if (is_number(value)) return Numbers{value.number};
    } else if (value.kind == JsonValue::Kind::list && value.items.size() == count) {
      Numbers found;
      for (std::size_t i = 0; i < count; ++i) {
        if (is_number(value.items[i]))
          found.push_back(value.items[i].number);
        else
          fault(value.line, fmt::format("{}[{}]", where, i),
                "must be a finite number, is " + describe(value.items[i]), "");
      }
      if (found.size() == count) return found;
      return std::nullopt;
    }
    fault(value.line, where, "must be " + wanted + ", is " + describe(value), "");
    return std::nullopt;
  }
  std::optional<Vector3> vector(const JsonValue& object, const char* key,
                                const std::string& where) {
    const JsonValue* value = object.find(key);
    if (!value) return std::nullopt;
    const std::optional<Numbers> found = numbers(*value, 3, where + key);
    if (!found) return std::nullopt;
    return Vector3(found->data());
  }

  // Unit length, to 1e-6: what was typed with few digits is brought to it, with a warning.
  void normalise(std::span<double> q, int line, const std::string& where) {
    constexpr double kRounding = 1e-15, kSilent = 1e-12, kFew = 1e-6;
    double square = 0;
    for (const double c : q) square += c * c;
    const double length = std::sqrt(square);
    if (!(std::abs(length - 1) <= kFew))
      return fault(
          line, where,
          "a quaternion (w, x, y, z) has length 1, this one has " + short_number_text(length),
          "divide it by its length");
    if (std::abs(length - 1) > kRounding)
      for (double& c : q) c /= length;
    if (std::abs(length - 1) > kSilent)
      state_.warnings.push_back(
          fmt::format("{}:{}: {}: the quaternion's length is off by {:.1e}; "
                      "it was normalised",
                      file_, line, where, length - 1));
  }

  // Calls take(joint, numbers) for every good entry of the object under `key`.
  template <class Count, class Take>
  void each_joint(const JsonValue& json, const char* key, Count count, Take take) {
    const JsonValue* object = json.find(key);
    if (!object || !is_object(*object, key)) return;
    for (const JsonValue& value : object->members) {
      const std::string& name = value.key;
      const std::string where = fmt::format("{} of joint '{}'", key, name);
      const NamedJoint* joint = coordinates_.find(name);
      if (!joint)
        refuse_joint(name, value.line, where);
      else if (const auto found = numbers(value, count(*joint), where))
        take(*joint, *found);
    }
  }
  void refuse_joint(const std::string& name, int line, const std::string& where) {
    for (const JointDescription& joint : robot_.joints) {
      if (joint.name != name) continue;
      if (joint.mimic)
        return fault(line, where, "it follows joint '" + joint.mimic->joint + "', and is not given",
                     "leave it out");
      return fault(line, where, "it is fixed, and has no coordinate", "leave it out");
    }
    fault(line, where, "there is no such joint", name_remedy(name, coordinates_.names(), "joints"));
  }

  void set_coordinates(const NamedJoint& joint, const Numbers& values, int line) {
    double* q = state_.x.q.data() + joint.iq;
    std::copy(values.begin(), values.end(), q);
    const std::string where = "q of joint '" + joint.name + "'";
    if (const int at = facts_of(joint.type).quaternion; at >= 0)
      normalise({q + at, 4}, line, where);
  }
  static void set_rows(const NamedJoint& joint, const Numbers& values, Eigen::VectorXd& rows) {
    for (std::size_t k = 0; k < joint.nv; ++k)
      rows[static_cast<Eigen::Index>(joint.row + k)] = values[k];
  }

  void read_base_pose(const JsonValue& json) {
    const JsonValue* base = json.find("base");
    if (!base || !is_object(*base, "base")) return;
    check_keys(*base, "base.",
               {"position", "orientation", "linear_velocity", "angular_velocity",
                "linear_acceleration", "angular_acceleration"});
    if (!coordinates_.floating())
      return fault(base->line, "base", "the root link stands on the world",
                   "give --floating, or leave 'base' out");
    double* q = state_.x.q.data() + coordinates_.base().iq;
    if (const auto p = vector(*base, "position", "base.")) std::copy(p->begin(), p->end(), q);
    if (const JsonValue* turn = base->find("orientation"))
      if (const auto values = numbers(*turn, 4, "base.orientation")) {
        std::copy(values->begin(), values->end(), q + 3);
        normalise({q + 3, 4}, turn->line, "base.orientation");
      }
  }
  void read_base_motion(const JsonValue& json) {
    const JsonValue* base = json.find("base");
    if (!base || base->kind != JsonValue::Kind::object) return;
    Eigen::Matrix<double, 6, 1> velocity = Eigen::Matrix<double, 6, 1>::Zero();
    Eigen::Matrix<double, 6, 1> acceleration = velocity;
    const auto put = [&](const char* key, Eigen::Matrix<double, 6, 1>& into, int first) {
      if (const auto v = vector(*base, key, "base.")) into.segment<3>(first) = *v;
    };
    put("linear_velocity", velocity, 0);
    put("angular_velocity", velocity, 3);
    put("linear_acceleration", acceleration, 0);
    put("angular_acceleration", acceleration, 3);
    if (!coordinates_.floating()) return;  // told already
    to_solver(coordinates_.base(), state_.x, velocity.data(), state_.x.qd);
    state_.qdd.head<6>() = acceleration;
  }

  void read_wrenches(const JsonValue& json) {
    const JsonValue* list = json.find("wrenches");
    if (!list) return;
    if (list->kind != JsonValue::Kind::list)
      return fault(list->line, "wrenches", "must be a list, is " + describe(*list),
                   "write [{\"link\": .., \"force\": [..]}]");
    for (std::size_t i = 0; i < list->items.size(); ++i)
      read_wrench(list->items[i], fmt::format("wrenches[{}]", i));
  }
  void read_wrench(const JsonValue& json, const std::string& where) {
    if (!is_object(json, where)) return;
    const std::string inside = where + ".";
    check_keys(json, inside, {"link", "frame", "point", "force", "torque"});
    Wrench wrench;
    const JsonValue* link = json.find("link");
    if (!link || link->kind != JsonValue::Kind::text)
      fault(json.line, inside + "link", "the name of the link that it acts on is missing",
            "give \"link\": \"NAME\"");
    else if (const auto body = find_link(link->text))
      wrench.body = *body;
    else
      fault(link->line, inside + "link", "there is no link '" + link->text + "'",
            name_remedy(link->text, link_names(), "links"));
    if (const JsonValue* frame = json.find("frame")) {
      wrench.in_link_axes = frame->kind == JsonValue::Kind::text && frame->text == "link";
      if (!wrench.in_link_axes && !(frame->kind == JsonValue::Kind::text && frame->text == "world"))
        fault(frame->line, inside + "frame",
              "must be \"world\" or \"link\", is " + describe(*frame), "");
    }
    wrench.point = vector(json, "point", inside).value_or(Vector3::Zero());
    wrench.force = vector(json, "force", inside).value_or(Vector3::Zero());
    wrench.torque = vector(json, "torque", inside).value_or(Vector3::Zero());
    state_.wrenches.push_back(wrench);
  }
  // Not find_body: that knows the world too, under its name.
  std::optional<std::size_t> find_link(const std::string& name) const {
    for (std::size_t i = 1; i < model_.body_name.size(); ++i)
      if (model_.body_name[i] == name) return i;
    return std::nullopt;
  }
  std::vector<std::string> link_names() const {
    return {model_.body_name.begin() + 1, model_.body_name.end()};
  }

  std::string file_;
  const RobotDescription& robot_;
  const Model<double>& model_;
  const Coordinates& coordinates_;
  FaultList& faults_;
  GivenState state_;
};

}  // namespace

GivenState default_state(const Model<double>& model, const Coordinates& coordinates) {
  GivenState state;
  state.x = State<double>(model);
  apply_mimics(model, state.x);
  state.tau = state.qdd = Eigen::VectorXd::Zero(coordinates.rows());
  state.has_tau.assign(coordinates.all().size(), false);
  return state;
}

GivenState read_state(const JsonValue& json, const std::filesystem::path& file,
                      const RobotDescription& robot, const Model<double>& model,
                      const Coordinates& coordinates, const GivenState& start, FaultList& faults) {
  return StateReader(file, robot, model, coordinates, start, faults).read(json);
}

}  // namespace twinarm
