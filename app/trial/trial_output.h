// What a trial leaves: a table for people, JSON, and one CSV of all subjects that names none of
// them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/trial/trial.h"

namespace twinarm {

struct TrialReport {
  std::string subject;  // a code, never a name
  std::string device, mapping;
  std::vector<TrialResult> results;  // in the order in which they were done
  std::string csv;
};

std::string trial_table(const TrialReport& report);
std::string trial_json(const TrialReport& report);
// Adds the row of the last result to a file of earlier ones. Throws InputError where the file is
// there and is no such table.
void add_last_to_csv(const TrialReport& report, const std::filesystem::path& file);
// "S1", or the next that the file has not.
std::string next_subject(const std::filesystem::path& file);

}  // namespace twinarm
