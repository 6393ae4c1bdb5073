// The scenes that are run in every engine, and by what each is judged: always the same number, from
// the coordinates that an engine gives back.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/scenes/scene.h"

namespace twinarm::bench {

// Is told every state that is looked at, in order; says how large the error is up to there.
using Judge =
    std::function<double(double t, const std::vector<double>& q, const std::vector<double>& v)>;

struct SceneCase {
  std::string name, group;  // as in `twinarm compare`, where there is a case of that name
  std::string what;         // one line: what moves
  std::string unit;         // of the error, with its measure: "m", "rad, rad/s"
  Scene scene;
  double step = 1e-3;           // [s]
  std::vector<double> times{};  // when it is looked at, multiples of 10 ms; none: after every step
  double duration = 0;          // [s]
  std::function<Judge()> judge{};
  bool work_precision = false;                              // also with many steps and tolerances
  std::vector<std::pair<std::string, double>> published{};  // by whom, error
};

std::vector<SceneCase> smooth_cases();   // without contacts
std::vector<SceneCase> contact_cases();  // with
std::vector<SceneCase> engine_cases();   // tasks with published results

}  // namespace twinarm::bench
