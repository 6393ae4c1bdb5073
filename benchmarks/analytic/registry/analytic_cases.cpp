#include "benchmarks/analytic/registry/analytic_cases.h"

#include <sstream>

namespace twinarm {

const std::vector<EmbeddedFile>& case_documents();  // docs/reference/cases/

namespace {

std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream in(list);
  for (std::string name; std::getline(in >> std::ws, name, ',');) names.push_back(name);
  return names;
}

// Joins an indented line to the one before.
std::string with_lines_joined(std::string text) {
  for (std::size_t at = 0; (at = text.find("\n  ", at)) != std::string::npos;)
    text.replace(at, 3, " ");
  return text;
}

void read_group(const EmbeddedFile& document, std::map<std::string, CaseText>& texts) {
  const std::string group(document.name.substr(0, document.name.find('.')));
  std::string statement;
  bool ended = true;  // whether the paragraph has ended, at an empty line
  std::istringstream in(with_lines_joined(std::string(document.text)));
  for (std::string line; std::getline(in, line); ended = line.empty()) {
    if (line.starts_with("- ")) {
      const std::size_t colon = line.find(": ");
      for (const std::string& name : names_in(line.substr(2, colon - 2)))
        texts[name] = {group, line.substr(colon + 2), statement};
    } else if (!line.empty()) {
      statement = ended ? line : statement + " " + line;
    }
  }
}

}  // namespace

const std::map<std::string, CaseText>& case_texts() {
  static const std::map<std::string, CaseText> all = [] {
    std::map<std::string, CaseText> texts;
    for (const EmbeddedFile& document : case_documents()) read_group(document, texts);
    return texts;
  }();
  return all;
}

const std::vector<AnalyticCase>& analytic_cases() {
  static const std::vector<AnalyticCase> all = [] {
    std::vector<CaseFamily> families;
    for (const auto* folder :
         {&joint_cases(), &loop_cases(), &contact_cases(), &coupling_cases(), &integrator_cases()})
      families.insert(families.end(), folder->begin(), folder->end());
    std::ranges::stable_sort(families, {}, &CaseFamily::order);
    std::vector<AnalyticCase> cases;
    for (const CaseFamily& family : families)
      cases.insert(cases.end(), family.cases.begin(), family.cases.end());
    for (AnalyticCase& c : cases)
      if (const auto text = case_texts().find(c.name); text != case_texts().end())
        static_cast<CaseText&>(c) = text->second;
    return cases;
  }();
  return all;
}

const std::vector<SkippedCase>& skipped_cases() {
  static const std::vector<SkippedCase> all = {
      {"D8", "loops",
       "rectangular Bricard mechanism: neither data nor reference values are published; see D4"},
      {"E14-capstan", "contact", "optional: belt friction needs a rope of many contacts"},
      {"E15", "contact", "optional: a silo needs thousands of grains"},
      {"F5", "robots", "the URDF with the parameters of the iiwa is not part of this program"},
      {"H1-anymal", "engines", "the model of the robot is not part of this program"},
      {"H2", "engines", "the models of hand and humanoid are not published"},
      {"H3", "engines", "a list of the tests of other engines, not a case"},
  };
  return all;
}

CaseResult run_case(const AnalyticCase& c) {
  if (!c.trajectory) return c.run();
  const TrajectoryResult result = run_trajectory(*c.trajectory, c.trajectory->integration);
  return {result.error, result.energy_drift,
          observed_order(*c.trajectory, c.trajectory->integration)};
}

}  // namespace twinarm
