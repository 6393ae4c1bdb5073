// References of the cases against an independent code that integrates with 30 digits and more
// (docs/reference/verification_cases.md).
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "benchmarks/analytic/registry/analytic_cases.h"

using namespace twinarm;

namespace {

const TrajectoryCase* find(const std::string& name) {
  for (const AnalyticCase& c : analytic_cases())
    if (name == c.name) return c.trajectory.get();
  return nullptr;
}

}  // namespace

TEST_CASE("references of the cases: the digits of an independent computation, to 1e-12") {
  std::ifstream file(TWINARM_SOURCE_DIR "/tests/benchmarks/analytic/registry/reference_digits.txt");
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    if (line[0] == '#') continue;
    CAPTURE(line);
    ++rows;
    std::istringstream in(line);
    std::string name;
    double argument = 0;
    in >> name >> argument;
    const CaseReadings values{std::istream_iterator<double>(in), {}};
    const TrajectoryCase* motion = find(name);
    REQUIRE(motion);
    CaseReadings exact = motion->reference(argument);
    REQUIRE(exact.size() == values.size());
    const bool attitude = motion->readings.size() == 7 && motion->readings[0] == "qw";
    const bool turned = attitude && exact[0] * values[0] < 0;
    for (std::size_t i = 0; turned && i < 4; ++i) exact[i] = -exact[i];
    double size = 1;
    for (const double value : values) size = std::max(size, std::abs(value));
    for (std::size_t i = 0; i < exact.size(); ++i)
      CHECK(std::abs(exact[i] - values[i]) < 1e-12 * size);
  }
  CHECK(rows == 90);
}

// The independent code is less accurate than 1e-12 there; the solution of the case agrees to 2e-14
// for steps from 1/512 to 1/4096 s.
TEST_CASE("references of the cases: the undamped coupling of F3, to 5e-11") {
  const CaseReadings exact = find("F3-undamped")->reference(3);
  const double elsewhere[] = {-1.542622579885601, 0.7725853769809631, -0.8066396833891154,
                              -0.6629241236732122};
  for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(exact[i] - elsewhere[i]) < 5e-11);
}
