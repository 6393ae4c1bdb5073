// Batched runs against single runs, and independence of the lanes.
#include "coupling/batch/batch_run.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/spatial/batch.h"
#include "solver/spatial/rotation_log.h"
#include "tests/coupling/batch/single_runs.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

void check_equal(const BatchResult& a, const BatchResult& b, double scale) {
  CHECK(a.steps == b.steps);
  REQUIRE(a.finished);
  REQUIRE(b.finished);
  for (std::size_t j = 0; j < 3; ++j) {
    CHECK(std::abs(a.max_error[j] - b.max_error[j]) < 1e-9);
    CHECK(std::abs(a.mean_error[j] - b.mean_error[j]) < 1e-9);
    CHECK(std::abs(a.target_lower[j] - b.target_lower[j]) < 1e-12);
    CHECK(std::abs(a.target_upper[j] - b.target_upper[j]) < 1e-12);
  }
  CHECK(std::abs(a.energy_created - b.energy_created) < 1e-9 * scale);
  CHECK(std::abs(a.input_work_min - b.input_work_min) < 1e-9 * scale);
}

}  // namespace

TEST_CASE("batched runs agree with single simulations, every coupling and discretization") {
  Random random(81);
  for (const Axes axes : kAxes)
    for (const BatchLaw& law : kBatchLaws)
      for (const Discretization discretization : kBatchTreatments)
        for (const bool absolute : {false, true}) {
          CAPTURE(static_cast<int>(axes));
          CAPTURE(law.name);
          CAPTURE(static_cast<int>(discretization));
          CAPTURE(absolute);
          const CellBench bench(tree_for_lanes(random, axes), law, discretization, absolute);
          std::vector<BatchCell> cells;
          for (int c = 0; c < 7; ++c) cells.push_back(bench.random_cell(random));
          std::vector<BatchResult> results(cells.size());
          BatchRun batch(bench.setup);
          batch.run(cells, results);
          for (std::size_t c = 0; c < cells.size(); ++c) {
            const BatchResult alone = OneByOne(bench.setup, cells[c]).run();
            check_equal(results[c], alone, 100);
          }
        }
}

TEST_CASE("a diverged run stops as in a single run, without effect on its neighbours") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Random random(82);
  const CellBench bench(tree_for_lanes(random, Axes::any), kBatchLaws[2], Discretization::explicit_,
                        false);
  std::vector<BatchCell> cells;
  for (int c = 0; c < 24; ++c) {
    cells.push_back(bench.random_cell(random));
    cells.back().h = 1e-3, cells.back().speed = 1, cells.back().delay = 0;
    for (auto& gains : cells.back().springs) gains.p_L = {0.1, 0, 0};
    if (c % 3 == 0)
      for (auto& gains : cells.back().springs)
        gains.b = c % 2 == 0 ? 1e5 : kInfinity;  // grows; is not NaN at once
  }
  std::vector<BatchResult> together(cells.size()), alone(cells.size());
  BatchRun batch(bench.setup);
  batch.run(cells, together);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    batch.run({&cells[c], 1}, {&alone[c], 1});
    const BatchResult scalar = OneByOne(bench.setup, cells[c]).run();
    CHECK(together[c].finished == (c % 3 != 0));
    CHECK(together[c].finished == scalar.finished);
    CHECK(together[c].steps == scalar.steps);
    CHECK(together[c].steps == alone[c].steps);
    CHECK(together[c].max_error == alone[c].max_error);
    CHECK(together[c].mean_error == alone[c].mean_error);
    CHECK(together[c].energy_created == alone[c].energy_created);
  }
}

TEST_CASE("results do not depend on the order of cells") {
  Random random(83);
  const CellBench bench(tree_for_lanes(random, Axes::in_line), kBatchLaws[0],
                        Discretization::implicit, false);
  std::vector<BatchCell> cells;
  for (int c = 0; c < 19; ++c) cells.push_back(bench.random_cell(random));
  std::vector<BatchResult> results(cells.size()), reversed(cells.size());
  BatchRun(bench.setup).run(cells, results);
  std::reverse(cells.begin(), cells.end());
  BatchRun(bench.setup).run(cells, reversed);
  std::reverse(reversed.begin(), reversed.end());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    CHECK(results[c].max_error == reversed[c].max_error);
    CHECK(results[c].energy_created == reversed[c].energy_created);
  }
}

TEST_CASE("the batched rotation vector agrees with that of the rotations, to 1e-14") {
  Random random(84);
  using S = Batch<4>;
  for (int n = 0; n < 4000; ++n) {
    Mat3<S> R;
    std::array<Vector3, 4> phi;
    for (int lane = 0; lane < 4; ++lane) {
      const double size = n % 4 == 0   ? std::pow(10, random.uniform(-12, 0))
                          : n % 4 == 1 ? 3.14159265 - std::pow(10, random.uniform(-7, 0))
                                       : random.uniform(0, 3.14);
      phi[static_cast<std::size_t>(lane)] = size * random.vector(1).normalized();
      const Vector3& v = phi[static_cast<std::size_t>(lane)];
      const Matrix3 M = Eigen::AngleAxisd(v.norm(), v.normalized()).toRotationMatrix();
      int row = 0;
      for (Vec3<S>* r : {&R.r0, &R.r1, &R.r2}) {
        r->x.set(lane, M(row, 0)), r->y.set(lane, M(row, 1)), r->z.set(lane, M(row, 2));
        ++row;
      }
    }
    const Vec3<S> found = twinarm::rotation_vector(R);
    for (int lane = 0; lane < 4; ++lane)
      CHECK((Vector3(found.x[lane], found.y[lane], found.z[lane]) -
             phi[static_cast<std::size_t>(lane)])
                .norm() < 1e-14);
  }
}

TEST_CASE("unsupported batched runs are rejected with all reasons at once") {
  Random random(85);
  auto bodies = random_bodies(random, 4, {JointType::revolute});
  bodies[1].type = JointType::universal;
  bodies[2].properties.coulomb_plus = 1;
  const Model<double> model = build(bodies);
  const WavingHand hand;
  BatchSetup setup;
  setup.model = &model;
  setup.start = State<double>(model);
  setup.targets = {{&hand, {{"joint1", "elbow"}, "", 0, 0}, setup.start}};
  setup.springs = {{SpringKind::world, Discretization::explicit_, false, 3, 0}};
  try {
    const BatchRun run(setup);
    FAIL("not refused");
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* fault : {"universal", "Coulomb", "elbow", "target 3 does not exist",
                              "not a moving link", "duration"}) {
      CAPTURE(fault);
      CHECK(text.find(fault) != std::string::npos);
    }
  }
}

TEST_CASE("each unsupported feature of a batched run is reported with a fix") {
  Random random(86);
  const CellBench bench(tree_for_lanes(random, Axes::in_line), kBatchLaws[1],
                        Discretization::implicit, false);
  const Model<double>& model = bench.model;
  const std::string fixed = model.joint_name[5], mimic_joint = model.joint_name[2];
  REQUIRE(model.joint[5] == JointType::fixed);
  REQUIRE(batch_faults(bench.setup).empty());
  const auto only = [&](const char* where, const char* code, const auto& spoil) {
    CAPTURE(code);
    BatchSetup setup = bench.setup;
    Model<double> own = model;
    spoil(setup, own);
    setup.model = &own;
    const std::vector<Diagnostic> faults = batch_faults(setup);
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].where == where);
    CHECK(faults[0].code == code);
    CHECK_FALSE(faults[0].fix.empty());
  };
  only(("joint '" + mimic_joint + "'").c_str(), "batch.mimic", [](BatchSetup&, Model<double>& own) {
    own.mimics.push_back({own.iv[2], own.iv[1], own.iq[2], own.iq[1], 1, 0});
  });
  only("targets", "batch.targets", [](BatchSetup& setup, Model<double>&) {
    setup.targets.clear();
    setup.springs.clear();
  });
  only(("joint '" + fixed + "'").c_str(), "batch.still-joint",
       [&](BatchSetup& setup, Model<double>&) { setup.targets[0].joints.gripper = fixed; });
  only("spring 0", "batch.joint", [](BatchSetup& setup, Model<double>&) {
    setup.springs[0].body = 5;  // fixed to a link that moves
  });
  only("measured", "batch.measured",
       [](BatchSetup& setup, Model<double>& own) { setup.measured.push_back(own.nq); });
  for (const double none : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    only("duration", "batch.duration",
         [&](BatchSetup& setup, Model<double>&) { setup.duration = none; });
  }
  only("duration", "batch.duration", [](BatchSetup& setup, Model<double>&) {
    setup.duration = std::numeric_limits<double>::infinity();
  });
}
