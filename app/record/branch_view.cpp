#include "app/record/record_run.h"

#include "app/data/tables.h"
#include "app/plot/gnuplot.h"

namespace twinarm {
namespace {

constexpr std::size_t kTableRows = 20, kTableWidth = 98, kCurves = 4;

// The motion that a column belongs to: a coordinate, a quaternion, or the position of a free body.
std::string motion_of(const RunColumn& column, const Replay& branch) {
  const std::string before_last = column.name.substr(0, column.name.rfind('/'));
  if (column.name.starts_with("q/")) return column.unit == "1" ? before_last : column.name;
  for (const std::string& body : branch.bodies)
    if (before_last == "links/" + body) return before_last;
  return "";  // follows from the coordinates
}

struct ValueDifference {
  std::size_t column;
  double size;
};

// The column with the largest difference of each motion, in descending order.
std::vector<ValueDifference> differences(const Recording& recording, const Replay& branch) {
  std::vector<double> max(recording.header().columns.size());
  for (std::size_t n = 0; n < branch.frames.size(); ++n) {
    const RecordedFrame recorded = recording.frame(branch.first + n);
    for (std::size_t c = 0; c < max.size(); ++c)
      max[c] = std::max(max[c], std::abs(branch.frames[n].values[c] - recorded.values[c]));
  }
  std::map<std::string, ValueDifference> by_motion;
  for (std::size_t c = 0; c < max.size(); ++c) {
    const std::string motion = motion_of(recording.header().columns[c], branch);
    if (motion.empty()) continue;
    ValueDifference& found =
        by_motion.try_emplace(motion, ValueDifference{c, max[c]}).first->second;
    if (max[c] > found.size) found = {c, max[c]};
  }
  std::vector<ValueDifference> order;
  for (const auto& [motion, found] : by_motion) order.push_back(found);
  std::ranges::stable_sort(order, std::greater(), &ValueDifference::size);
  return order;
}

void print_values(const Recording& recording, const Replay& branch) {
  constexpr std::size_t max_number = 12, between = 2;
  std::vector<std::size_t> columns;
  std::vector<std::string> headings{"t [s]"};
  std::size_t width = max_number;
  const std::vector<ValueDifference> all = differences(recording, branch);
  for (const auto& [c, size] : all) {
    if (size == 0) break;
    const RunColumn& column = recording.header().columns[c];
    const std::string heading = column.name + " [" + column.unit + "]";
    width += std::max(heading.size(), max_number) + max_number + 2 * between;
    if (!columns.empty() && width > kTableWidth) break;
    columns.push_back(c);
    headings.insert(headings.end(), {heading, "branch"});
  }
  if (columns.empty()) {
    fmt::print("no value of the branch differs from the recording\n");
    return;
  }
  fmt::print("\n");
  TextTable table(std::move(headings));
  const std::size_t count = branch.frames.size();
  const std::size_t stride = std::max<std::size_t>(1, (count + kTableRows - 1) / kTableRows);
  for (std::size_t n = 0; n < count; n = n + 1 == count ? count : std::min(n + stride, count - 1)) {
    const RecordedFrame recorded = recording.frame(branch.first + n);
    std::vector<std::string> row{cell(recorded.t)};
    for (const std::size_t c : columns) {
      row.push_back(cell(recorded.values[c]));
      row.push_back(cell(branch.frames[n].values[c]));
    }
    table.add(std::move(row));
  }
  fmt::print("{}", table.str());
}

std::size_t index_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

// Work of a row since the first frame; 0 before the row appears.
std::vector<double> works_since(const Replay& branch, const std::string& name) {
  const std::size_t number = index_of(branch.rows, name);
  std::vector<double> works;
  for (const RecordedFrame& frame : branch.frames) {
    double work = 0;
    for (std::size_t i = 0; i < frame.rows.size(); ++i)
      if (frame.rows[i] == number) work = frame.works[i];
    works.push_back(work);
  }
  const double first = works.empty() ? 0 : works.front();
  for (double& work : works) work -= first;
  return works;
}

Eigen::Matrix<double, 6, 1> momentum_in(const Replay& branch, std::size_t frame,
                                        const std::string& name) {
  Eigen::Matrix<double, 6, 1> found = Eigen::Matrix<double, 6, 1>::Zero();
  const std::size_t number = index_of(branch.momentum_rows, name);
  const RecordedFrame& at = branch.frames[frame];
  for (std::size_t i = 0; i < at.momentum_rows.size(); ++i)
    if (at.momentum_rows[i] == number) found << at.momenta[2 * i], at.momenta[2 * i + 1];
  return found;
}

// `numerical` stays last.
std::vector<std::string> names_of_both(std::vector<std::string> names,
                                       const std::vector<std::string>& others) {
  for (const std::string& name : others)
    if (index_of(names, name) == names.size()) names.push_back(name);
  std::stable_partition(names.begin(), names.end(),
                        [](const std::string& name) { return name != kNumericalRow; });
  return names;
}

void print_balances(const ComparedBalances& balances, double from, double to) {
  const std::string span = fmt::format("{} to {} s", cell(from), cell(to));
  TextTable works({"energy balance, " + span, "recorded [J]", "branch [J]", "difference [J]"});
  double recorded = 0, branch = 0;
  for (const ComparedWork& row : balances.works) {
    if (row.recorded != 0 || row.branch != 0)
      works.add({row.name, cell(row.recorded), cell(row.branch), cell(row.branch - row.recorded)});
    recorded += row.recorded, branch += row.branch;
  }
  works.add({"change of kinetic energy", cell(recorded), cell(branch), cell(branch - recorded)});
  TextTable momenta({"momentum, " + span, "recorded", "branch", "difference"});
  static const char* const kParts[] = {", x [N s]",         ", y [N s]",
                                       ", z [N s]",         ", about x [N m s]",
                                       ", about y [N m s]", ", about z [N m s]"};
  for (const ComparedMomentum& row : balances.momenta)
    for (int i = 0; i < 6; ++i) {  // without components that are zero to rounding
      const double a = row.recorded[i], b = row.branch[i];
      if (cell(a) != "0" || cell(b) != "0")
        momenta.add({row.name + kParts[i], cell(a), cell(b), cell(b - a)});
    }
  fmt::print("\n{}\n{}", works.str(), momenta.str());
}

// The rows with the largest differences.
std::vector<std::string> differing_rows(const ComparedBalances& balances) {
  std::vector<ComparedWork> rows = balances.works;
  std::ranges::stable_sort(rows, [](const ComparedWork& a, const ComparedWork& b) {
    return std::abs(a.branch - a.recorded) > std::abs(b.branch - b.recorded);
  });
  std::vector<std::string> names;
  for (const ComparedWork& row : rows)
    if (names.size() < kCurves && row.branch != row.recorded) names.push_back(row.name);
  return names;
}

std::string panel_at(double bottom, double top, const std::string& label) {
  return fmt::format(
      "set bmargin at screen {}\nset tmargin at screen {}\nset lmargin at screen 0.095\n"
      "set rmargin at screen 0.72\nset ylabel {} offset 0.6,0 textcolor '#333333'\n",
      bottom, top, in_quotes(label));
}

}  // namespace

ComparedBalances compared_balances(const Replay& recorded, const Replay& branch) {
  ComparedBalances found;
  if (recorded.frames.empty() || branch.frames.empty()) return found;
  for (const std::string& name : names_of_both(recorded.rows, branch.rows))
    found.works.push_back(
        {name, works_since(recorded, name).back(), works_since(branch, name).back()});
  const auto gained = [](const Replay& run, const std::string& name) {
    return Eigen::Matrix<double, 6, 1>(momentum_in(run, run.frames.size() - 1, name) -
                                       momentum_in(run, 0, name));
  };
  for (const std::string& name : names_of_both(recorded.momentum_rows, branch.momentum_rows))
    found.momenta.push_back({name, gained(recorded, name), gained(branch, name)});
  return found;
}

void print_branch(const Recording& recording, const Replay& recorded, const Replay& branch) {
  print_values(recording, branch);
  print_balances(compared_balances(recorded, branch), branch.from, branch.to);
}

void draw_branch(const Recording& recording, const Replay& recorded, const Replay& branch,
                 const std::vector<std::string>& changes, const std::filesystem::path& file) {
  const std::vector<ValueDifference> found = differences(recording, branch);
  if (found.empty() || branch.frames.size() < 2)
    throw InputError({{file.string(), 0, "--plot", "there is no motion to draw",
                       "record a run that moves, or leave --plot out", "plot.nothing-moves"}});
  const std::size_t shown = found.front().column;
  const RunColumn& column = recording.header().columns[shown];
  std::vector<double> t, first, second;
  for (std::size_t n = 0; n < branch.frames.size(); ++n) {
    t.push_back(branch.frames[n].t);
    first.push_back(recording.frame(branch.first + n).values[shown]);
    second.push_back(branch.frames[n].values[shown]);
  }
  std::string change;
  for (const std::string& text : changes) change += (change.empty() ? "" : ", ") + text;
  Gnuplot gnuplot;
  std::string script = fmt::format(
      "set multiplot\nset xrange [{}:{}]\nset key at screen 0.735,0.93 left top Left reverse\n{}"
      "set format x ''\nset label 1 {} at screen 0.095,0.965 textcolor '#333333'\n"
      "plot {} with lines lw 4 lc '{}' title 'recorded', {} with lines lw 1.5 lc '{}' title "
      "'branch'\nunset label 1\n",
      branch.from, branch.to, panel_at(0.58, 0.925, column.name + " [" + column.unit + "]"),
      in_quotes("branch at " + cell(branch.from) + " s: " + change), gnuplot.curve(t, first),
      palette::kvr, gnuplot.curve(t, second), palette::dvr);
  script +=
      "set key at screen 0.735,0.52 left top Left reverse\nset format x '%g'\n"
      "set xlabel 'time [s]' offset 0,0.3 textcolor '#333333'\n" +
      panel_at(0.12, 0.51, "work, branch - recorded [J]") + "plot 0 lc '#9A9A9A' lw 1 notitle";
  static const char* const kColours[] = {palette::torsional, palette::linear, palette::dvr,
                                         palette::ink};
  std::size_t curve = 0;
  for (const std::string& name : differing_rows(compared_balances(recorded, branch))) {
    std::vector<double> parts = works_since(branch, name);
    const std::vector<double> there = works_since(recorded, name);
    for (std::size_t n = 0; n < parts.size() && n < there.size(); ++n) parts[n] -= there[n];
    script += fmt::format(", {} with lines lw {} lc '{}' title {}", gnuplot.curve(t, parts),
                          3.2 - 0.6 * static_cast<double>(curve), kColours[curve], in_quotes(name));
    ++curve;
  }
  write_whole_file(file, gnuplot.svg("branch", "Recording and branch: " + column.name, 1000, 620,
                                     script + "\nunset multiplot\n"));
}

}  // namespace twinarm
