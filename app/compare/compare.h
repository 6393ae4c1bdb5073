// The analytic cases that were asked for, run one after another.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "benchmarks/analytic/analytic_case.h"

namespace twinarm {

struct CompareRow {
  const AnalyticCase* test;
  CaseResult result;
  double seconds;
};

// Those of these names, and all of the group (empty: none); all there are where both are empty.
// "E1" also stands for all that begin with "E1-". Throws InputError with all names that nothing
// has.
std::vector<const AnalyticCase*> select_cases(const std::vector<std::string>& names,
                                              const std::string& group);

// `tick` is called before each case with its place in the list; it may throw.
std::vector<CompareRow> run_cases(const std::vector<const AnalyticCase*>& cases,
                                  const std::function<void(std::size_t)>& tick);

// How many fell short.
std::size_t failures(const std::vector<CompareRow>& rows);

// For people: a table, and what fell short below it. For programs: one JSON object.
std::string compare_table(const std::vector<CompareRow>& rows);
std::string compare_json(const std::vector<CompareRow>& rows);

}  // namespace twinarm
