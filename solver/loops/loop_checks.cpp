// Checks of loop closures.
#include "solver/loops/loop_types.h"

namespace twinarm {
namespace {

std::string called(const LoopClosure& loop) {
  return "loop '" + loop.name + "'";
}
bool is_frame(const Pose& X) {
  return X.p.allFinite() && (X.R * X.R.transpose() - Matrix3::Identity()).norm() < 1e-9 &&
         X.R.determinant() > 0;
}
bool same_pose(const Pose& a, const Pose& b) {
  return a.R == b.R && a.p == b.p;
}
bool same(const LoopClosure& a, const LoopClosure& b) {
  if (a.type != b.type || a.body_a != b.body_a) return false;
  const LoopBetween ends = facts_of(a.type).ends;
  if (ends == LoopBetween::one_joint) return true;
  if (a.body_b != b.body_b) return false;
  return ends == LoopBetween::joints ||
         (same_pose(a.X_LaC, b.X_LaC) && same_pose(a.X_LbC, b.X_LbC));
}
bool moves_between(const Model<double>& model, int a, int b) {
  std::size_t dofs = 0;
  while (a != b) {
    int& higher = a > b ? a : b;
    const auto i = static_cast<std::size_t>(higher);
    dofs += model.dofs(i);
    higher = model.parent[i];
  }
  return dofs > 0;
}

class OneLoop {
 public:
  OneLoop(const Model<double>& model, const LoopClosure& loop, DiagnosticList& faults)
      : model_(model), loop_(loop), faults_(faults) {}

  void check() {
    bool bodies = is_body(loop_.body_a, "a");
    if (ends_ != LoopBetween::one_joint) bodies = is_body(loop_.body_b, "b") && bodies;
    if (ends_ == LoopBetween::bodies && (!is_frame(loop_.X_LaC) || !is_frame(loop_.X_LbC)))
      add("frame X_LaC or X_LbC is not finite, or its R is not a rotation matrix",
          "give a rotation matrix R and a finite p");
    const LoopProblem own = visit_loop(loop_.type, [&](auto type) { return type.problem(loop_); });
    if (!own.problem.empty()) add(own.problem, own.fix);
    if (!bodies) return;
    if (ends_ != LoopBetween::bodies) return check_joints();
    if (!moves_between(model_, loop_.body_a, loop_.body_b))
      add("both ends are on the same rigid body: no joint lies between them",
          "close the loop between other bodies");
  }

 private:
  void add(std::string problem, std::string fix) {
    faults_.add(called(loop_), std::move(problem), std::move(fix), "loop.ends");
  }
  bool is_body(int body, const char* end) {
    if (body >= 0 && body < model_.body_count()) return true;
    add(std::string("body ") + end + " is " + std::to_string(body) + ", of 0 .. " +
            std::to_string(model_.body_count() - 1),
        "use an index of Model::find_body");
    return false;
  }
  bool has_one_dof(int body) {
    const auto i = static_cast<std::size_t>(body);
    if (body > 0 && model_.dofs(i) == 1) return true;
    add("the joint of body " + std::to_string(body) + " (" + name_of(model_.joint[i]) + ") has " +
            std::to_string(model_.dofs(i)) + " degrees of freedom, must have one",
        "use a weld, or another joint");
    return false;
  }
  void check_joints() {
    has_one_dof(loop_.body_a);
    if (ends_ == LoopBetween::one_joint) return;
    has_one_dof(loop_.body_b);
    if (loop_.body_a == loop_.body_b) add("both ends are the same joint", "give two joints");
  }

  const Model<double>& model_;
  const LoopClosure& loop_;
  const LoopBetween ends_ = facts_of(loop_.type).ends;
  DiagnosticList& faults_;
};

// By loop: its errors, including duplicates of earlier loops.
std::vector<DiagnosticList> faults_by_loop(const Model<double>& model,
                                           const std::vector<LoopClosure>& loops) {
  std::size_t rows = 0;
  for (const LoopClosure& loop : loops)
    visit_loop(loop.type, [&](auto type) { rows += decltype(type)::rows; });
  if (rows * model.nv > kMaxLoopEntries)
    throw InputError(
        {{"", 0, "loops",
          std::to_string(rows) + " constraint rows on " + std::to_string(model.nv) +
              " velocities: more than " + std::to_string(kMaxLoopEntries) + " matrix entries",
          "give fewer loops or bodies", "loop.too-many"}});
  std::vector<DiagnosticList> faults(loops.size());
  for (std::size_t l = 0; l < loops.size(); ++l) {
    OneLoop(model, loops[l], faults[l]).check();
    for (std::size_t other = 0; other < l; ++other)
      if (same(loops[l], loops[other]))
        faults[l].add(called(loops[l]), "duplicate of " + called(loops[other]),
                      "remove one of the two", "loop.twice");
  }
  return faults;
}

// Hinges and welds: g = 0 also holds for axes in opposite directions.
bool has_opposite_axes(const LoopClosure& loop, const Kinematics& k) {
  const Matrix3 R = (k.X_WL[static_cast<std::size_t>(loop.body_a)].R * loop.X_LaC.R).transpose() *
                    k.X_WL[static_cast<std::size_t>(loop.body_b)].R * loop.X_LbC.R;
  return visit_loop(loop.type, [&](auto type) { return type.has_opposite_axes(R); });
}

void add_open(const Model<double>& model, const LoopClosure& loop, const State<double>& x,
              DiagnosticList& faults) {
  const Kinematics k = kinematics_at(model, x);
  LoopClosures alone(model, {loop});
  alone.evaluate(x, k);
  const double error = alone.g().lpNorm<Eigen::Infinity>();
  const std::string fix = "give initial joint positions that close the loop";
  if (has_opposite_axes(loop, k))
    faults.add(called(loop),
               "axes of the two frames point in opposite directions in the initial state", fix,
               "loop.turned-over");
  else if (!(error <= kMaxInitialError))
    faults.add(called(loop),
               "position error is " + short_number_text(error) +
                   " (m or rad) in the initial state, allowed " +
                   short_number_text(kMaxInitialError),
               fix, "loop.open");
}

void throw_all(const std::vector<DiagnosticList>& by_loop) {
  DiagnosticList all;
  for (const DiagnosticList& faults : by_loop) all.add(faults.faults());
  all.check();
}

}  // namespace

void check_loops(const Model<double>& model, const std::vector<LoopClosure>& loops) {
  throw_all(faults_by_loop(model, loops));
}

void check_loops(const Model<double>& model, const std::vector<LoopClosure>& loops,
                 const State<double>& x) {
  std::vector<DiagnosticList> faults = faults_by_loop(model, loops);
  for (std::size_t l = 0; l < loops.size(); ++l)
    if (faults[l].empty()) add_open(model, loops[l], x, faults[l]);
  throw_all(faults);
}

}  // namespace twinarm
