// Tracking errors of driven and other joints under the same operator motion, all joints coupled.

#include "coupling/analysis/tracking.h"
#include "app/robot/robot_input.h"
#include "app/zwidth/zwidth.h"
#include "coupling/analysis/gains.h"
#include "coupling/analysis/joint_space_stiffness.h"
#include "coupling/target/operator_motion.h"
#include "coupling/target/synthetic_operator.h"

namespace twinarm {
namespace {

constexpr SpringResponse kResponse{50, 1};  // [rad/s], 1

struct TrackingCase {
  const char *name, *file;
  std::vector<std::string> driven;
};

// A joint spring for each joint, by its joint-space inertia at the start.
CouplingSpec joint_springs(const Model<double>& model, const State<double>& x) {
  CouplingSpec spec;
  spec.measure = SpringSpace::joint;
  spec.discretization = Discretization::implicit;
  const Eigen::MatrixXd M = mass_matrix(model, x);
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    if (model.dofs(i) != 1) continue;
    const SpringGains gains =
        gains_of(kResponse, joint_inertia(M, static_cast<Eigen::Index>(model.iv[i])));
    spec.springs.push_back({model.joint_name[i], static_cast<int>(i), {}, gains.k, gains.b});
  }
  return spec;
}

void follow(const TrackingCase& what, const Model<double>& model, const OperatorMotion& motion,
            const std::string& motion_name, const std::function<void()>& look,
            std::vector<TrackingRow>& rows) {
  TrackingSetup setup;
  setup.kvr_model = setup.dvr_model = &model;
  setup.motion = &motion;
  setup.joints.turned = what.driven;
  const TargetRobot begin(model, motion, setup.mapping, setup.joints);
  setup.couplings = {joint_springs(model, begin.start().x)};
  TrackingSystem system(setup);
  const std::vector<Spring>& springs = system.coupling(0).springs();
  const std::size_t first = rows.size();
  for (const Spring& spring : springs)
    rows.push_back({what.name, motion_name, spring.name,
                    std::ranges::find(what.driven, spring.name) != what.driven.end(),
                    is_translational(model.joint[static_cast<std::size_t>(spring.body)])});
  long samples = 0;
  system.run([&](double t) {
    if (++samples % 256 == 0) look();
    const TargetSample& K = system.kvr().at(t);
    for (std::size_t s = 0; s < springs.size(); ++s) {
      const std::size_t iq = model.iq[static_cast<std::size_t>(springs[s].body)];
      const double e = std::abs(K.x.q[iq] - system.simulation().state().q[iq]);
      rows[first + s].max = std::max(rows[first + s].max, e);
      rows[first + s].mean += e;
    }
  });
  for (std::size_t s = 0; s < springs.size(); ++s)
    rows[first + s].mean /= static_cast<double>(std::max(1L, samples));
}

}  // namespace

std::vector<TrackingRow> measure_follows(const std::filesystem::path& assets, unsigned seed,
                                         const Tell& tell) {
  const TrackingCase cases[] = {{"S-103", "robots/s103/s103.urdf", {"joint1", "joint2", "joint3"}},
                                {"PUMA 560", "robots/puma560/puma560.urdf", {"j1", "j2", "j3"}}};
  const AutomaticMotion automatic{OperatorMapping{}};
  const SyntheticOperator synthetic(seed, 10);
  std::vector<TrackingRow> rows;
  double done = 0;
  for (const TrackingCase& what : cases) {
    RobotOptions options;
    options.model = assets / what.file;
    const RobotInput input = read_robot_input(options);
    const auto look = [&] { tell(done); };
    follow(what, input.model, automatic, "automatic", look, rows);
    follow(what, input.model, synthetic, "synthetic", look, rows);
    tell(done += 0.5);
  }
  return rows;
}

}  // namespace twinarm
