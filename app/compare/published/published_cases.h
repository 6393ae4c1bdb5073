// Numbers that others have published: group "published" of `twinarm compare`.
//
// A folder of assets/published/PROJECT/ holds `case.toml` and its model;
// docs/develop/adding_a_case.md has the keys. Each number is a column of `simulate --csv --forces`,
// or of `dynamics` at the start, and is as exact as its digits: the case passes if every answer is
// within a unit of the last one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/run/simulate_input.h"
#include "benchmarks/analytic/support/analytic_case.h"

namespace twinarm {

struct PublishedNumber {
  std::string quantity;  // "links/mass/x", "qdd/j1", "M/j1/j2", "tau/j1", "bias/j1", "gravity/j1"
  std::string unit;      // as the program prints it
  std::string digits;    // as published
  double time = 0;       // [s]
  double value() const { return std::stod(digits); }
  double last_digit() const;  // a unit of it
};

struct PublishedCase {
  std::string name;
  std::string title, source, address;
  SimulateOptions options;
  std::vector<PublishedNumber> numbers;
};

// Throws InputError with all errors.
PublishedCase read_published_case(const std::filesystem::path& file, std::string name);
// Of the program, in the order of the numbers; not a number where the run has diverged before.
// Throws InputError, also for a unit that is not that of the quantity.
std::vector<double> answers_of(const PublishedCase& published);
// Its error is the largest of all numbers, in units of their last digits.
AnalyticCase case_of(const PublishedCase& published);

// All cases, "P-PROJECT-CASE", by name; the first call reads them. Throws likewise.
const std::vector<AnalyticCase>& published_cases();

}  // namespace twinarm
