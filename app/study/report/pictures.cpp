#include "app/study/report/pictures.h"

#include <fmt/format.h>

#include <cmath>

#include "app/render/gl/painter.h"
#include "app/study/findings/obstacle.h"
#include "app/study/obstacle_scene.h"
#include "app/support/interrupt.h"

namespace twinarm {
namespace {

constexpr int kWidth = 1280, kHeight = 720;

class Pictures {
 public:
  Pictures(const StudyInputs& inputs, const StudyRobot& robot, std::filesystem::path folder,
           bool paper_view)
      : inputs_(inputs),
        robot_(robot),
        folder_(std::move(folder)),
        paper_view_(paper_view),
        scene_(inputs.s103, robot.kvr_model()) {}

  void portrait() {
    scene_.clear();
    State<double> x(robot_.kvr_model());
    set_turned(x, {0.55, -0.9, 0.0});
    Kinematics k(robot_.kvr_model());
    forward_kinematics(robot_.kvr_model(), x, k);
    scene_.add_robot(k);
    scene_.list().legend.clear();
    scene_.list().title = "Unimate S-103, drawn for this study";
    paint("robot.png", Quality::studio);
  }

  // Both robots at the largest error of joint 1, or of joint 2 if that is larger.
  void at_largest_error(const RunResult& result) {
    const TrackingSeries& s = result.series;
    std::size_t worst = 0;
    double largest = 0;
    for (std::size_t n = 0; n < s.t.size(); ++n)
      for (std::size_t j = 0; j < 2; ++j)
        if (std::abs(s.q_K[j][n] - s.q_D[j][n]) > largest) {
          largest = std::abs(s.q_K[j][n] - s.q_D[j][n]);
          worst = n;
        }
    const Kinematics k_K = pose(s.q_K, worst), k_D = pose(s.q_D, worst);
    std::vector<SpringReading> readings;
    const Gains& g = result.spec.gains;
    const bool linear = result.spec.coupling.type == CouplingSpec::Type::linear;
    std::size_t index = 0;
    for (const Spring& spring : robot_.springs(g.k1, g.b1, g.k2, g.b2)) {
      SpringReading reading;
      const Vector3 p_L = linear ? spring.p_L : Vector3::Zero();
      reading.p_K = k_K.position(spring.body, p_L);
      reading.p_D = k_D.position(spring.body, p_L);
      reading.size = s.pull[index++][worst];
      // The series keeps the size of a couple; the spring turns the DVR towards the KVR.
      const auto i = static_cast<std::size_t>(spring.body);
      const double turn = rotation_vector(k_K.X_WL[i].R * k_D.X_WL[i].R.transpose()).z();
      reading.pull = Vector3(0, 0, std::copysign(reading.size, turn));
      readings.push_back(reading);
    }
    scene_.clear();
    scene_.add_robot(k_D);
    if (!paper_view_) scene_.add_ghost(k_K);
    if (!paper_view_ && linear) scene_.add_springs(readings, "N");
    if (!paper_view_ && !linear) scene_.add_couples(readings);
    scene_.look(-60, 30, 2.3, {0.26, 0, 0.60});
    scene_.list().title =
        fmt::format("{} at its largest error, t = {:.2f} s", result.spec.name, s.t[worst]);
    paint(result.spec.name + ".png", Quality::normal);
  }

  void stopped(TrackingSystem& system, CouplingSpec::Type type) {
    const bool linear = type == CouplingSpec::Type::linear;
    const ObstacleScene box = obstacle_scene(inputs_.settings);
    scene_.clear();
    scene_.add_robot(system.simulation().kinematics());
    if (!paper_view_) {
      scene_.add_ghost(system.kvr().at(system.simulation().state().t).k);
      if (linear) scene_.add_springs(system.coupling(0).readings(), "N");
      if (!linear) scene_.add_couples(system.coupling(0).readings());
    }
    scene_.add_obstacle(box.X_WB, box.size);
    scene_.look(30, 26, 2.75, {0.30, -0.12, 0.52});  // sees the face that stops the DVR
    scene_.list().title =
        fmt::format("{} coupling, t = {:.2f} s: the DVR is stopped, the KVR goes on",
                    linear ? "Linear" : "Torsional", system.simulation().state().t);
    paint(linear ? "obstacle-linear.png" : "obstacle-torsional.png", Quality::normal);
  }

 private:
  void set_turned(State<double>& x, const std::array<double, 3>& q) const {
    const Model<double>& model = robot_.kvr_model();
    for (std::size_t j = 0; j < 3; ++j)
      x.q[model.iq[static_cast<std::size_t>(model.find_joint(robot_.joints().turned[j]))]] = q[j];
  }
  Kinematics pose(const std::vector<std::vector<double>>& q, std::size_t n) const {
    State<double> x(robot_.kvr_model());
    set_turned(x, {q[0][n], q[1][n], q[2][n]});
    Kinematics k(robot_.kvr_model());
    forward_kinematics(robot_.kvr_model(), x, k);
    return k;
  }
  void paint(const std::string& file, Quality quality) {
    check_interrupt();
    Painter painter(Backend::osmesa, kWidth, kHeight, quality);
    write_png((folder_ / file).string(), painter.paint(scene_.list()));
  }

  const StudyInputs& inputs_;
  const StudyRobot& robot_;
  std::filesystem::path folder_;
  bool paper_view_;
  RobotScene scene_;
};

}  // namespace

void run_obstacles_and_paint(const StudyInputs& inputs, const StudyRobot& robot,
                             StudyResults& results, const std::filesystem::path& folder,
                             bool paper_view, Progress& progress) {
  Pictures pictures(inputs, robot, folder / "pictures", paper_view);
  pictures.portrait();
  progress.advance(0.4);
  pictures.at_largest_error(results.reproduction.at(2));
  pictures.at_largest_error(results.reproduction.at(3));
  progress.advance(0.7);
  for (CouplingSpec::Type type : {CouplingSpec::Type::linear, CouplingSpec::Type::torsional})
    results.obstacle.push_back(run_obstacle(
        inputs, robot, type, [&](TrackingSystem& system) { pictures.stopped(system, type); }));
}

}  // namespace twinarm
