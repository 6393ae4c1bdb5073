// Statements of the cases.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "benchmarks/analytic/registry/analytic_cases.h"

using namespace twinarm;

TEST_CASE("cases: every case has a statement with a formula") {
  for (const AnalyticCase& c : analytic_cases()) {
    CAPTURE(std::string(c.name));
    CHECK(std::string(c.group) != "");
    CHECK(std::string(c.reference) != "");
    const std::string statement = c.statement;
    const std::size_t open = statement.find("<p>"), close = statement.find("</p>");
    CHECK(open != std::string::npos);
    CHECK(close != std::string::npos);
    CHECK(open + 4 < close);
    CHECK(statement.size() > 20);
  }
}

TEST_CASE("cases: docs/reference/cases/ describes existing cases only") {
  std::set<std::string> names;
  for (const AnalyticCase& c : analytic_cases()) names.insert(c.name);
  for (const auto& described : case_texts()) {
    CAPTURE(described.first);
    CHECK(names.contains(described.first));
  }
}

TEST_CASE("cases: the sources on a page are those of this folder") {
  bool found = false;
  for (const EmbeddedFile& source : case_sources())
    found |= source.name == "joints/pendulum.cpp" &&
             source.text.find("TrajectoryCase swing_in_plane()") != std::string_view::npos;
  CHECK(found);
}
