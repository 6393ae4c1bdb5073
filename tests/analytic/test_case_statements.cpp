// What the cases say of themselves, for people.
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "benchmarks/analytic/registry/analytic_cases.h"
#include "benchmarks/analytic/registry/case_sources.h"
#include "benchmarks/analytic/registry/case_statements.h"

using namespace twinarm;

TEST_CASE("cases: every one says what is known of it, with a formula") {
  for (const AnalyticCase& c : analytic_cases()) {
    CAPTURE(std::string(c.name));
    const char* found = statement_of(c);
    REQUIRE(found != nullptr);
    const std::string statement = found;
    const std::size_t open = statement.find("<p>"), close = statement.find("</p>");
    CHECK(open != std::string::npos);
    CHECK(close != std::string::npos);
    CHECK(open + 4 < close);
    CHECK(statement.size() > 20);
  }
}

TEST_CASE("cases: no statement stands for nothing, none is there twice") {
  for (const auto* table : {&contact_statements(), &other_statements()}) {
    std::set<std::string> names;
    for (const CaseStatement& one : *table) {
      const std::string name(one.name);
      CAPTURE(name);
      CHECK(names.insert(name).second);
      bool used = false;
      for (const AnalyticCase& c : analytic_cases()) used |= statement_of(c) == one.text;
      CHECK(used);
    }
  }
}

TEST_CASE("cases: an entry for the very case counts more than one for all that begin alike") {
  const auto text = [](const char* name) {
    AnalyticCase c{name, "contact", "", 0, nullptr};
    const char* found = statement_of(c);
    return std::string(found ? found : "");
  };
  CHECK(text("E1-times") == text("E1-speeds"));
  CHECK(text("E1-rest") != text("E1-times"));
  CHECK(text("E16-flight") == text("E16"));  // and not that of E1
  CHECK(text("E99").empty());
}

TEST_CASE("cases: the files that a page quotes are those of this folder") {
  bool found = false;
  for (const CaseSource& source : case_sources())
    found |= source.file == "joints/pendulum.cpp" &&
             source.text.find("TrajectoryCase swing_time()") != std::string_view::npos;
  CHECK(found);
}
