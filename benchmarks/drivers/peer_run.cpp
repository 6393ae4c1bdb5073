#include "benchmarks/drivers/peer_run.h"

#include <algorithm>
#include <exception>

#include "benchmarks/engines/engine.h"

namespace twinarm::bench {
namespace {

// When a run is looked at.
std::vector<double> looks(const SceneCase& c) {
  if (!c.times.empty()) return c.times;
  std::vector<double> all;
  for (long n = 1; n <= std::lround(c.duration / c.step); ++n)
    all.push_back(static_cast<double>(n) * c.step);
  return all;
}

// The first run: what it comes to. Looking is not timed.
void observe(Row& row, double budget) {
  row.engine->load(row.test->scene, row.scheme, row.h);
  const Judge judge = row.test->judge();
  std::vector<double> q, v;
  double spent = 0;
  for (const double t : looks(*row.test)) {
    const double start = thread_seconds();
    row.engine->advance(t);
    spent += thread_seconds() - start;
    row.engine->read(q, v);
    row.error = judge(t, q, v);
    if (!row.scheme.adaptive) row.steps = std::lround(t / row.h);
    if (!std::isfinite(row.error)) {
      row.stopped = "not a number after " + std::to_string(t) + " s";
      break;
    }
    if (spent > budget && t < row.test->duration - 1e-9) {
      row.stopped = "took longer than the budget, after " + std::to_string(t) + " s of the scene";
      break;
    }
  }
  row.seconds.push_back(spent);
}

// Those that follow: nothing but the steps. As often as a clock needs.
void repeat(Row& row) {
  constexpr double kLongEnough = 2e-3;
  const std::vector<double> times =
      row.test->times.empty() ? std::vector{row.test->duration} : row.test->times;
  double spent = 0;
  int runs = 0;
  do {
    row.engine->load(row.test->scene, row.scheme, row.h);
    const double start = thread_seconds();
    for (const double t : times) row.engine->advance(t);
    spent += thread_seconds() - start;
    ++runs;
  } while (spent < kLongEnough);
  row.seconds.push_back(spent / runs);
}

std::string name_of(const Row& row) {
  return row.test->name + ", " + row.name + ' ' + row.scheme.name;
}

}  // namespace

// A step costs a microsecond for each body, ten with contacts.
double expected_seconds(const Row& row, double budget) {
  constexpr double kAdaptive = 0.05;
  if (row.scheme.adaptive) return kAdaptive;
  const Scene& scene = row.test->scene;
  const double step = (scene.floor ? 1e-5 : 1e-6) * static_cast<double>(scene.bodies.size());
  return std::min(row.test->duration / row.h * step, budget);
}

double expected_of_all(const Row& row, int repetitions, double budget) {
  const double once = expected_seconds(row, budget);
  return repetitions > 1 && once < kOnceIsEnough ? once * (1 + repetitions) : once;
}

void measure(std::vector<Row>& rows, int repetitions, double budget, Stages& stages) {
  const auto worth_repeating = [&](const Row& row) {
    return repetitions > 1 && row.stopped.empty() && row.seconds[0] < kOnceIsEnough;
  };
  std::vector<Row*> repeated;
  for (Row& row : rows) {
    const double once = expected_seconds(row, budget);
    stages.begin(name_of(row), once);
    try {
      observe(row, budget);
    } catch (const std::exception& fault) {
      row.stopped = fault.what(), row.error = NAN;
    }
    if (worth_repeating(row)) repeated.push_back(&row);
    const double comes = worth_repeating(row) ? repetitions * once : 0;
    stages.skip(expected_of_all(row, repetitions, budget) - once - comes);
  }
  for (Row* row : repeated) row->seconds.clear();  // they had looks in them, and cold caches
  for (int n = 0; n < repetitions && repetitions > 1; ++n)
    for (Row* row : repeated) {
      stages.begin_seldom(name_of(*row) + ", again", expected_seconds(*row, budget));
      repeat(*row);
    }
}

}  // namespace twinarm::bench
