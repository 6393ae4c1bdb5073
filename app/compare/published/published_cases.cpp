#include "app/compare/published/published_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>

#include "app/data/table_reader.h"
#include "app/inspect/series/force_series.h"
#include "app/robot/dynamics.h"
#include "app/robot/robot_output.h"
#include "app/support/files.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

const std::regex kNumber(R"(([+-]?\d{1,30})(?:\.(\d{0,30}))?(?:[eE]([+-]?\d{1,2}))?)");

struct TextKey {
  const char* key;
  std::string* text;
  const char* fix;  // if it is missing
};
void read_texts(TableReader& table, std::initializer_list<TextKey> keys) {
  for (const auto& [key, text, fix] : keys) {
    table.missing(key, fix);
    *text = table.text(key).value_or("");
  }
}

PublishedNumber read_number(TableReader& table) {
  PublishedNumber number;
  read_texts(table, {{"quantity", &number.quantity, "give a column of simulate --csv --forces"},
                     {"unit", &number.unit, "give the unit of the column"},
                     {"published", &number.digits, "give the number as it is printed, as a text"}});
  if (!number.digits.empty() && !std::regex_match(number.digits, kNumber))
    table.fault("published", "is not a number", "give its digits, as \"-1.250e-3\"",
                "published.digits");
  number.time = table.not_negative("time").value_or(0);
  table.done();
  return number;
}

// Columns of `dynamics` at the start: values by name, and their units.
struct Static {
  std::string name, unit;
  double value;
};
std::vector<Static> static_values(const RobotInput& robot) {
  const Dynamics d = compute_dynamics(robot);
  const std::vector<std::string> rows = row_names(robot.coordinates);
  std::vector<std::string> units;
  for (const NamedJoint& joint : robot.coordinates.all())
    for (const JointComponent& c : joint.components())
      if (c.v >= 0) units.push_back(c.is_angle ? "N m" : "N");
  std::vector<Static> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    for (const auto& [before, values] :
         {std::pair("tau/", &d.tau_inverse), {"bias/", &d.bias}, {"gravity/", &d.gravity}})
      all.push_back({before + rows[i], units[i], (*values)[k]});
    for (std::size_t j = 0; j < rows.size(); ++j) {
      const int angles = (units[i] == "N m") + (units[j] == "N m");
      all.push_back({"M/" + rows[i] + "/" + rows[j],
                     std::array{"kg", "kg m", "kg m^2"}[static_cast<std::size_t>(angles)],
                     d.mass_matrix(k, static_cast<Eigen::Index>(j))});
    }
  }
  return all;
}

void check_unit(const PublishedCase& of, const PublishedNumber& number, const std::string& unit) {
  if (number.unit == unit) return;
  throw InputError(of.name + ", " + number.quantity,
                   "has the unit " + unit + ", not " + number.unit, "give the number in " + unit,
                   "published.unit");
}

// The columns at the times of the plan; without those after a divergence.
std::map<double, std::vector<double>> run_of(const SimulateOptions& options,
                                             std::vector<RunColumn>& columns) {
  const SimulatePlan prepared = prepare_simulation(options);
  const RobotInput& robot = prepared.input.robot;
  ForceSeries forces(options);
  columns = run_columns(robot, &forces);
  std::map<double, std::vector<double>> rows;
  RunWatch watch;
  watch.look = [&](SteppedRun& run) { forces.keep(run); };
  watch.sample = [&](double t, const State<double>& x) {
    rows[t] = run_values(robot, x, kinematics_at(robot.model, x), &forces);
  };
  run_plan(prepared.input, prepared.run, watch);
  return rows;
}

}  // namespace

double PublishedNumber::last_digit() const {
  std::smatch parts;
  if (!std::regex_match(digits, parts, kNumber)) return std::nan("");
  const int exponent = parts[3].matched ? std::stoi(parts[3]) : 0;
  return std::pow(10.0, exponent - static_cast<int>(parts[2].length()));
}

PublishedCase read_published_case(const std::filesystem::path& file, std::string its_name) {
  DiagnosticList faults;
  const Value root = read_toml(file);
  const std::string name = file.string();
  TableReader table(root, "the case", name, faults);
  PublishedCase made;
  made.name = std::move(its_name);
  read_texts(table, {{"title", &made.title, "say what is measured"},
                     {"source", &made.source, "name program, version, file and test"},
                     {"address", &made.address, "give the address of the file, with its commit"}});
  table.missing("model", "name the robot or scene beside this file");
  made.options.robot.model = file.parent_path() / table.text("model").value_or("");
  if (const auto state = table.text("state"))
    made.options.robot.state = file.parent_path() / *state;
  made.options.integrator = table.text("integrator").value_or("");
  made.options.step = table.positive("step");
  made.options.tolerance = table.positive("tolerance");
  table.missing("number", "give the published numbers, as [[number]]");
  double end = 0;
  std::vector<double> times;
  for (const Value* entry : table.tables("number")) {
    TableReader number(*entry, "number", name, faults);
    made.numbers.push_back(read_number(number));
    times.push_back(made.numbers.back().time);
    end = std::max(end, times.back());
  }
  table.done();
  faults.check();
  constexpr double kShort = 1e-3;  // [s]
  made.options.duration = end > 0 ? end : kShort;
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  for (const double t : times)
    made.options.at += (made.options.at.empty() ? "" : ",") + number_text(t);
  return made;
}

std::vector<double> answers_of(const PublishedCase& published) {
  const SimulatePlan prepared = prepare_simulation(published.options);
  std::vector<Static> at_start;  // of a robot
  if (!prepared.input.scene) at_start = static_values(prepared.input.robot);
  std::vector<RunColumn> columns;
  std::map<double, std::vector<double>> rows;
  std::vector<double> answers;
  for (const PublishedNumber& number : published.numbers) {
    const auto given = std::ranges::find(at_start, number.quantity, &Static::name);
    if (given != at_start.end()) {
      check_unit(published, number, given->unit);
      answers.push_back(given->value);
      continue;
    }
    if (columns.empty()) rows = run_of(published.options, columns);
    const auto column = std::ranges::find(columns, number.quantity, &RunColumn::name);
    if (column == columns.end())
      throw InputError(published.name + ", " + number.quantity, "there is no such quantity",
                       name_remedy(number.quantity, names_of(columns), "columns"),
                       "published.quantity");
    check_unit(published, number, column->unit);
    const auto row = rows.find(number.time);
    answers.push_back(row == rows.end()
                          ? std::nan("")
                          : row->second[static_cast<std::size_t>(column - columns.begin())]);
  }
  return answers;
}

AnalyticCase case_of(const PublishedCase& published) {
  AnalyticCase made("P-" + published.name, 1, [published](bool) {
    CaseResult result;
    const std::vector<double> answers = answers_of(published);
    for (std::size_t i = 0; i < answers.size(); ++i) {
      const PublishedNumber& number = published.numbers[i];
      const double units = std::abs(answers[i] - number.value()) / number.last_digit();
      if (!(units <= result.error) && !std::isnan(result.error)) result.error = units;
      result.numbers.push_back(
          {number.quantity + (number.time > 0 ? fmt::format(" at {:g} s", number.time) : ""),
           number.unit, number.digits, answers[i], units});
    }
    return result;
  });
  made.group = "published";
  made.reference = published.title + " [units of the last published digit]";
  made.statement = fmt::format("{}. Published: <a href=\"{}\">{}</a>.", escaped(published.title),
                               escaped(published.address), escaped(published.source));
  return made;
}

const std::vector<AnalyticCase>& published_cases() {
  static const std::vector<AnalyticCase> all = [] {
    std::vector<std::filesystem::path> files;
    const std::filesystem::path folder = find_assets() / "published";
    if (std::filesystem::is_directory(folder))
      for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().filename() == "case.toml") files.push_back(entry.path());
    std::ranges::sort(files);
    std::vector<AnalyticCase> cases;
    for (const auto& file : files) {
      const std::string place = std::filesystem::relative(file.parent_path(), folder).string();
      cases.push_back(case_of(read_published_case(file, replace_all(place, "/", "-"))));
    }
    return cases;
  }();
  return all;
}

}  // namespace twinarm
