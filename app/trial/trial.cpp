#include "app/trial/trial.h"

#include "app/scene/read/read_scene.h"
#include "app/servo/output/servo_output.h"
#include "app/support/progress.h"

namespace twinarm {
namespace {

constexpr std::size_t kMeasured = 2;  // joints, as in the paper

// Task: bring an object from one place of the table to another, in the horizontal plane.
//
// The gripper picks the object if the button is pressed within kReach of it, and carries it while
// the button is held. Released within kReach of the goal it is placed, elsewhere dropped. The
// object has no mass: the task measures positioning.
struct PickAndPlace {
  static constexpr double kReach = 0.03;  // [m]
  const Vector3 goal{0.42, -0.28, 0};     // world [m]; z is ignored
  Vector3 object{0.42, 0.28, 0};
  bool is_carried = false, is_placed = false;
  int picks = 0, drops = 0;               // drop: outside the goal
  double picked_at = -1, placed_at = -1;  // first time [s]; negative: never

  // Once a tick, at its time [s].
  void tick(double t, const Vector3& gripper, bool closed) {
    const bool closes = closed && !was_closed_, opens = !closed && was_closed_;
    was_closed_ = closed;
    if (is_placed) return;
    if (closes && horizontal_distance(gripper, object) <= kReach) {
      is_carried = true;
      ++picks;
      if (picked_at < 0) picked_at = t;
    }
    if (is_carried) object.head<2>() = gripper.head<2>();
    if (!is_carried || !opens) return;
    is_carried = false;
    is_placed = off() <= kReach;
    if (is_placed)
      placed_at = t;
    else
      ++drops;
  }
  double off() const { return horizontal_distance(object, goal); }  // from the goal [m]

 private:
  static double horizontal_distance(const Vector3& a, const Vector3& b) {
    return (a - b).head<2>().norm();
  }
  bool was_closed_ = false;
};

// Top view of the table in characters, x to the right, y up: robot, target robot, object and goal.
// World coordinates; later marks cover earlier ones.
class TopView {
 public:
  void point(const Vector3& p, char mark) {
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1e3) return;
    const double column = std::floor((p.x() + kHalf) / (2 * kHalf) * kColumns);
    const double row = std::floor((kHalf - p.y()) / (2 * kHalf) * kRows);
    if (column < 0 || column >= kColumns || row < 0 || row >= kRows) return;
    lines_[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = mark;
  }
  void line(const Vector3& a, const Vector3& b, char mark) {
    const int steps = 2 * kColumns;  // two points per character
    for (int i = 0; i <= steps; ++i) point(a + (b - a) * i / steps, mark);
  }
  std::string text() const {  // lines in a frame
    const std::string edge = "+" + std::string(kColumns, '-') + "+\n";
    std::string all = edge;
    for (const std::string& line : lines_) all += "|" + line + "|\n";
    return all + edge;
  }

 private:
  static constexpr double kHalf = 0.66;                      // from the middle to each side [m]
  static constexpr int kColumns = 66, kRows = kColumns / 2;  // a character is twice as high as wide
  std::vector<std::string> lines_ = std::vector<std::string>(kRows, std::string(kColumns, ' '));
};

// Poses and tracking errors of the robot and its target robot from the ticks.
class TaskWatch {
 public:
  TaskWatch(const SceneModel& scene, const DrivenJoints& joints, bool is_kinematic)
      : model_(scene.model), is_kinematic_(is_kinematic), x_(scene.start), k_(scene.model) {
    for (const std::string& name : joints.turned) driven_.push_back(body(name));
    tip_ = joints.gripper.empty() ? driven_.back() : body(joints.gripper);
    max_.assign(std::min(kMeasured, driven_.size()), 0);
    sum_ = max_;
  }

  void look(const TickResult& tick, PickAndPlace* task) {
    ++ticks_;
    for (std::size_t j = 0; j < max_.size(); ++j) {
      max_[j] = std::max(max_[j], std::abs(tick.error[j]));
      sum_[j] += std::abs(tick.error[j]);
    }
    pose(tick, is_kinematic_);
    if (task) task->tick(tick.motion.t + tick.motion.h, k_.X_WL[tip_].p, tick.motion.sample.button);
  }
  std::string picture(const TickResult& tick, const PickAndPlace* task) {
    TopView table;
    for (const double side : {-1.0, 1.0})
      if (task)
        table.point(task->goal + Vector3(side * PickAndPlace::kReach, 0, 0), side < 0 ? '[' : ']');
    pose(tick, true);
    draw(table, is_kinematic_ ? '#' : '.');
    if (!is_kinematic_) {
      pose(tick, false);
      draw(table, '#');
    }
    if (task) table.point(task->object, task->is_carried ? '@' : 'o');
    return table.text();
  }
  void finish(TrialResult& result) const {
    if (is_kinematic_) return;
    for (std::size_t j = 0; j < max_.size(); ++j) {
      result.max_deg.push_back(max_[j] / kDegree);
      result.mean_deg.push_back(sum_[j] / kDegree / static_cast<double>(std::max(1L, ticks_)));
    }
  }

 private:
  std::size_t body(const std::string& joint) const {
    return static_cast<std::size_t>(model_.find_joint(joint));
  }
  void pose(const TickResult& tick, bool kinematic) {
    const OperatorMapping mapping;
    for (std::size_t j = 0; j < std::min<std::size_t>(3, driven_.size()); ++j)
      x_.q[model_.iq[driven_[j]]] =
          mapping.robot_angle(tick.motion.sample, j) - (kinematic ? 0 : tick.error[j]);
    forward_kinematics(model_, x_, k_);
  }
  void draw(TopView& table, char mark) const {
    Vector3 last = k_.X_WL[driven_.front()].p;
    for (std::size_t j = 1; j < driven_.size(); ++j) {
      table.line(last, k_.X_WL[driven_[j]].p, mark);
      last = k_.X_WL[driven_[j]].p;
    }
    table.point(k_.X_WL[tip_].p, mark == '#' ? 'V' : 'v');
  }

  const Model<double>& model_;
  bool is_kinematic_;
  State<double> x_;
  Kinematics k_;
  std::vector<std::size_t> driven_;
  std::size_t tip_ = 0;
  std::vector<double> max_, sum_;
  long ticks_ = 0;
};

}  // namespace

TrialResult run_task(const TrialCondition& condition, InputDevice& device,
                     const MappingSpec& mapping, const TrialTask& task,
                     const std::filesystem::path& log_file) {
  const SceneModel scene = build_scene(read_scene(condition.scene));
  LiveOptions options;
  options.mapping = mapping;
  if (condition.is_kinematic) options.mapping.force_scale = 0;
  LiveRun run(scene, device, options);
  TaskWatch watch(scene, scene.couplings[run.leader()].driven, condition.is_kinematic);
  PickAndPlace progress;
  PickAndPlace* const pick = task.is_pick_and_place ? &progress : nullptr;
  LiveLog log(log_file);
  const ServoPlan plan{.duration = task.seconds, .real_time = task.real_time};
  std::atomic<bool> done{false};
  double reached = 0;
  bool stopped = false;
  const ServoResult servo = run_servo(run, plan, done, [&](SpscRing<TickResult>& ring) {
    TickResult tick, newest;
    bool any = false;
    while (!progress.is_placed && ring.pop(tick)) {
      watch.look(tick, pick);
      log.write(tick.motion);
      newest = tick;
      any = true;
      reached = tick.motion.t + tick.motion.h;
    }
    log.flush();
    if (any && task.show) task.show(watch.picture(newest, pick), reached);
    stopped = stopped || is_interrupted();
    if (stopped || progress.is_placed) done = true;
  });
  log.finish();

  TrialResult result;
  result.condition = condition.name;
  result.task = pick ? "pick-and-place" : "free";
  result.seconds = progress.is_placed ? progress.placed_at : reached;
  result.is_done = servo.finite && !stopped && (!pick || progress.is_placed);
  if (pick) {
    result.picks = progress.picks;
    result.drops = progress.drops;
    result.picked_at = progress.picked_at;
    result.placement_error_mm = 1e3 * progress.off();
  }
  result.log = log_file.string();
  watch.finish(result);
  return result;
}

}  // namespace twinarm
