#include "app/record/branch_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/accounting/energy_balance.h"
#include "app/data/tables.h"
#include "app/plot/gnuplot.h"
#include "app/support/files.h"
#include "solver/support/atomic_file.h"
#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

constexpr std::size_t kTableRows = 20, kTableWidth = 98, kCurves = 4;

// What moves as one: the numbers of a quaternion, and the three of a place.
std::string motion_of(const RecordedColumn& column, const Replay& fork) {
  const std::string before_last = column.name.substr(0, column.name.rfind('/'));
  if (column.name.starts_with("q/")) return column.unit == "1" ? before_last : column.name;
  for (const std::string& body : fork.bodies)
    if (before_last == "links/" + body) return before_last;
  return "";  // links follow from coordinates, velocities and energies from them too
}

struct Parted {
  std::size_t column;
  double by;
};

// Of each motion the value that parts most; the most first.
std::vector<Parted> parted(const Recording& recording, const Replay& fork) {
  std::vector<double> most(recording.header().columns.size());
  for (std::size_t n = 0; n < fork.frames.size(); ++n) {
    const RecordedFrame recorded = recording.frame(fork.first + n);
    for (std::size_t c = 0; c < most.size(); ++c)
      most[c] = std::max(most[c], std::abs(fork.frames[n].values[c] - recorded.values[c]));
  }
  std::map<std::string, Parted> by_motion;
  for (std::size_t c = 0; c < most.size(); ++c) {
    const std::string motion = motion_of(recording.header().columns[c], fork);
    if (motion.empty()) continue;
    Parted& found = by_motion.try_emplace(motion, Parted{c, most[c]}).first->second;
    if (most[c] > found.by) found = {c, most[c]};
  }
  std::vector<Parted> order;
  for (const auto& [motion, found] : by_motion) order.push_back(found);
  std::ranges::stable_sort(order, [](const Parted& a, const Parted& b) { return a.by > b.by; });
  return order;
}

void print_values(const Recording& recording, const Replay& fork) {
  constexpr std::size_t max_number = 12, between = 2;
  std::vector<std::size_t> columns;
  std::vector<std::string> headings{"t [s]"};
  std::size_t width = max_number;
  const std::vector<Parted> all = parted(recording, fork);
  for (const auto& [c, by] : all) {
    if (by == 0) break;
    const RecordedColumn& column = recording.header().columns[c];
    const std::string heading = column.name + " [" + column.unit + "]";
    width += std::max(heading.size(), max_number) + max_number + 2 * between;
    if (!columns.empty() && width > kTableWidth) break;
    columns.push_back(c);
    headings.insert(headings.end(), {heading, "fork"});
  }
  if (columns.empty()) {
    fmt::print("no value of the fork differs from the recording\n");
    return;
  }
  fmt::print("\n");
  TextTable table(std::move(headings));
  const std::size_t count = fork.frames.size();
  const std::size_t stride = std::max<std::size_t>(1, (count + kTableRows - 1) / kTableRows);
  for (std::size_t n = 0; n < count; n = n + 1 == count ? count : std::min(n + stride, count - 1)) {
    const RecordedFrame recorded = recording.frame(fork.first + n);
    std::vector<std::string> row{cell(recorded.t)};
    for (const std::size_t c : columns) {
      row.push_back(cell(recorded.values[c]));
      row.push_back(cell(fork.frames[n].values[c]));
    }
    table.add(std::move(row));
  }
  fmt::print("{}", table.str());
}

std::size_t place_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

// Of all frames, since the first; a row comes in when it first does something.
std::vector<double> works_since(const Replay& branch, const std::string& name) {
  const std::size_t number = place_of(branch.rows, name);
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
  const std::size_t number = place_of(branch.momentum_rows, name);
  const RecordedFrame& at = branch.frames[frame];
  for (std::size_t i = 0; i < at.momentum_rows.size(); ++i)
    if (at.momentum_rows[i] == number) found << at.momenta[2 * i], at.momenta[2 * i + 1];
  return found;
}

// `numerical` stays last.
std::vector<std::string> names_of_both(std::vector<std::string> names,
                                       const std::vector<std::string>& others) {
  for (const std::string& name : others)
    if (place_of(names, name) == names.size()) names.push_back(name);
  std::stable_partition(names.begin(), names.end(),
                        [](const std::string& name) { return name != kNumericalRow; });
  return names;
}

void print_ledgers(const ComparedBalances& ledgers, double from, double to) {
  const std::string span = fmt::format("{} to {} s", cell(from), cell(to));
  TextTable works({"work on the bodies, " + span, "recorded [J]", "fork [J]", "difference [J]"});
  double recorded = 0, fork = 0;
  for (const ComparedWork& row : ledgers.works) {
    if (row.recorded != 0 || row.fork != 0)
      works.add({row.name, cell(row.recorded), cell(row.fork), cell(row.fork - row.recorded)});
    recorded += row.recorded, fork += row.fork;
  }
  works.add({"change of kinetic energy", cell(recorded), cell(fork), cell(fork - recorded)});
  TextTable momenta({"momentum, " + span, "recorded", "fork", "difference"});
  static const char* const kParts[] = {", x [N s]",         ", y [N s]",
                                       ", z [N s]",         ", about x [N m s]",
                                       ", about y [N m s]", ", about z [N m s]"};
  for (const ComparedMomentum& row : ledgers.momenta)
    for (int i = 0; i < 6; ++i) {  // components that stay zero but for rounding are left out
      const double a = row.recorded[i], b = row.fork[i];
      if (cell(a) != "0" || cell(b) != "0")
        momenta.add({row.name + kParts[i], cell(a), cell(b), cell(b - a)});
    }
  fmt::print("\n{}\n{}", works.str(), momenta.str());
}

// The rows that part most.
std::vector<std::string> parted_rows(const ComparedBalances& ledgers) {
  std::vector<ComparedWork> rows = ledgers.works;
  std::ranges::stable_sort(rows, [](const ComparedWork& a, const ComparedWork& b) {
    return std::abs(a.fork - a.recorded) > std::abs(b.fork - b.recorded);
  });
  std::vector<std::string> names;
  for (const ComparedWork& row : rows)
    if (names.size() < kCurves && row.fork != row.recorded) names.push_back(row.name);
  return names;
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.parent_path().empty() ? "." : file.parent_path();
}

std::string panel_at(double bottom, double top, const std::string& label) {
  return fmt::format(
      "set bmargin at screen {}\nset tmargin at screen {}\nset lmargin at screen 0.095\n"
      "set rmargin at screen 0.72\nset ylabel {} offset 0.6,0 textcolor '#333333'\n",
      bottom, top, in_quotes(label));
}

}  // namespace

void check_plot(const std::filesystem::path& file) {
  std::error_code ignored;
  if (file.extension() != ".svg" || std::filesystem::is_directory(file, ignored))
    throw InputError({{file.string(), 0, "--plot", "is drawn as SVG, a file",
                       "give a name that ends in .svg", "file.ending"}});
  require_gnuplot();
  make_folder(folder_of(file), "--plot");
}

ComparedBalances compared_ledgers(const Replay& recorded, const Replay& fork) {
  ComparedBalances found;
  if (recorded.frames.empty() || fork.frames.empty()) return found;
  for (const std::string& name : names_of_both(recorded.rows, fork.rows))
    found.works.push_back(
        {name, works_since(recorded, name).back(), works_since(fork, name).back()});
  const auto gained = [](const Replay& branch, const std::string& name) {
    return Eigen::Matrix<double, 6, 1>(momentum_in(branch, branch.frames.size() - 1, name) -
                                       momentum_in(branch, 0, name));
  };
  for (const std::string& name : names_of_both(recorded.momentum_rows, fork.momentum_rows))
    found.momenta.push_back({name, gained(recorded, name), gained(fork, name)});
  return found;
}

void print_fork(const Recording& recording, const Replay& recorded, const Replay& fork) {
  print_values(recording, fork);
  print_ledgers(compared_ledgers(recorded, fork), fork.from, fork.to);
}

void draw_fork(const Recording& recording, const Replay& recorded, const Replay& fork,
               const std::vector<std::string>& changes, const std::filesystem::path& file) {
  const std::vector<Parted> found = parted(recording, fork);
  if (found.empty())
    throw InputError({{file.string(), 0, "--plot", "nothing moves that could be drawn", "",
                       "plot.nothing-moves"}});
  const std::size_t shown = found.front().column;
  const RecordedColumn& column = recording.header().columns[shown];
  std::vector<double> t, first, second;
  for (std::size_t n = 0; n < fork.frames.size(); ++n) {
    t.push_back(fork.frames[n].t);
    first.push_back(recording.frame(fork.first + n).values[shown]);
    second.push_back(fork.frames[n].values[shown]);
  }
  std::string change;
  for (const std::string& text : changes) change += (change.empty() ? "" : ", ") + text;
  Gnuplot gnuplot;
  std::string script = fmt::format(
      "set multiplot\nset xrange [{}:{}]\nset key at screen 0.735,0.93 left top Left reverse\n{}"
      "set format x ''\nset label 1 {} at screen 0.095,0.965 textcolor '#333333'\n"
      "plot {} with lines lw 4 lc '{}' title 'recorded', {} with lines lw 1.5 lc '{}' title "
      "'fork'\nunset label 1\n",
      fork.from, fork.to, panel_at(0.58, 0.925, column.name + " [" + column.unit + "]"),
      in_quotes("fork at " + cell(fork.from) + " s: " + change), gnuplot.curve(t, first),
      palette::kvr, gnuplot.curve(t, second), palette::dvr);
  script +=
      "set key at screen 0.735,0.52 left top Left reverse\nset format x '%g'\n"
      "set xlabel 'time [s]' offset 0,0.3 textcolor '#333333'\n" +
      panel_at(0.12, 0.51, "work, fork - recorded [J]") + "plot 0 lc '#9A9A9A' lw 1 notitle";
  static const char* const kColours[] = {palette::torsional, palette::linear, palette::dvr,
                                         palette::ink};
  std::size_t curve = 0;
  for (const std::string& name : parted_rows(compared_ledgers(recorded, fork))) {
    std::vector<double> parts = works_since(fork, name);
    const std::vector<double> there = works_since(recorded, name);
    for (std::size_t n = 0; n < parts.size() && n < there.size(); ++n) parts[n] -= there[n];
    script += fmt::format(", {} with lines lw {} lc '{}' title {}", gnuplot.curve(t, parts),
                          3.2 - 0.6 * static_cast<double>(curve), kColours[curve], in_quotes(name));
    ++curve;
  }
  write_whole_file(file, gnuplot.svg("fork", "Recorded run and fork: " + column.name, 1000, 620,
                                     script + "\nunset multiplot\n"));
}

}  // namespace twinarm
