// Every case of the list (benchmarks/analytic/support/analytic_case.h) against its reference.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "benchmarks/analytic/registry/analytic_cases.h"

using namespace twinarm;

TEST_CASE("analytic cases: unique names, groups and references") {
  std::set<std::string> names;
  for (const AnalyticCase& c : analytic_cases()) {
    CAPTURE(std::string(c.name));
    CHECK(names.insert(c.name).second);
    CHECK_FALSE(std::string(c.group).empty());
    CHECK_FALSE(std::string(c.reference).empty());
    CHECK(c.tolerance >= 0);
  }
  CHECK(names.size() > 50);
}

TEST_CASE("analytic cases: tolerances are those of a table that does not follow the code") {
  std::map<std::string, double> table;
  std::ifstream file(TWINARM_SOURCE_DIR "/tests/benchmarks/analytic/registry/tolerances.txt");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    double tolerance = 0;
    char colon = 0;
    if (!(words >> tolerance >> colon)) continue;
    for (std::string name; words >> name;) table[name] = tolerance;
  }
  CHECK(table.size() > 250);
  for (const AnalyticCase& c : analytic_cases()) {
    CAPTURE(std::string(c.name));
    if (const auto row = table.find(c.name); row != table.end())
      CHECK(c.tolerance == doctest::Approx(row->second).epsilon(1e-9));
    table.erase(c.name);
  }
  for (const auto& row : table) FAIL_CHECK(row.first << " is no case");
}

TEST_CASE("analytic cases: every experiment meets its tolerance") {
  for (const AnalyticCase& c : analytic_cases()) {
    if (c.trajectory) continue;
    CAPTURE(std::string(c.name));
    CAPTURE(std::string(c.reference));
    CHECK(c.run().error <= c.tolerance);
  }
}

TEST_CASE("analytic cases: every experiment has a mutant, which fails") {
  for (const AnalyticCase& c : analytic_cases()) {
    if (c.trajectory) continue;
    CAPTURE(std::string(c.name));
    const bool has_one = c.mutant != nullptr;
    REQUIRE(has_one);
    const double error = c.mutant().error;
    CHECK(std::isfinite(error));
    CHECK(error > c.tolerance);
  }
}
