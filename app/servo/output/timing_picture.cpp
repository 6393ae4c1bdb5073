#include <fmt/format.h>

#include <algorithm>

#include "app/plot/gnuplot.h"
#include "app/servo/output/servo_output.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

struct Columns {
  std::vector<double> at, share;  // [us], [%] of all ticks
};

// By quarters of an octave; empty bins are gaps of a logarithmic axis.
Columns columns_of(const TickTimes& times) {
  constexpr int kTogether = 4;
  Columns columns;
  for (int bin = 0; bin + kTogether <= TickTimes::kBins; bin += kTogether) {
    long count = 0;
    for (int i = 0; i < kTogether; ++i) count += times.count(bin + i);
    columns.at.push_back(1e6 * TickTimes::upper_edge(bin + kTogether / 2));
    columns.share.push_back(100.0 * static_cast<double>(count) /
                            static_cast<double>(std::max(1L, times.count())));
  }
  return columns;
}

// One panel: a stepped curve for the run, and one for the empty loop.
std::string panel(Gnuplot& gnuplot, const std::string& label, const TickTimes& run,
                  const TickTimes& empty, double limit, const std::string& limit_name) {
  const Columns ours = columns_of(run), control = columns_of(empty);
  std::string script = fmt::format(
      "set xlabel {}\nset ylabel 'share of all ticks [%]'\nset logscale xy\n"
      "set xrange [0.1:20000]\nset yrange [{}:150]\nset format y '%g'\nset format x '%g'\n",
      in_quotes(label), 50.0 / static_cast<double>(std::max(1L, run.count())));
  script += fmt::format(
      "set arrow 1 from {0},graph 0 to {0},graph 0.9 nohead dashtype 2 lc rgb '{1}'\n"
      "set label 1 {2} at {0},graph 0.94 center front tc rgb '{1}'\n",
      limit, palette::faint, in_quotes(limit_name));
  script += fmt::format(
      "plot {} using 1:($2 > 0 ? $2 : 1/0) with impulses lw 3 lc rgb '{}' title "
      "'with the robot'",
      gnuplot.data({ours.at, ours.share}), palette::dvr);
  if (empty.count() > 0)
    script += fmt::format(
        ", {} using ($1*1.06):($2 > 0 ? $2 : 1/0) with impulses lw 3 lc rgb '{}' "
        "title 'an empty loop'",
        gnuplot.data({control.at, control.share}), palette::kvr);
  return script + "\nunset arrow 1\nunset label 1\n";
}

}  // namespace

void draw_timing(const LiveSummary& summary, const std::filesystem::path& file) {
  Gnuplot gnuplot;
  const TickFigures& run = summary.servo.run;
  const TickFigures& empty = summary.servo.empty;
  const std::string script =
      "set multiplot layout 1,2 margins 0.085,0.98,0.17,0.86 spacing 0.1,0.1\n"
      "set key at graph 1,1.14 right top horizontal\n" +
      panel(gnuplot, "processor time of a tick [us]", run.cpu, empty.cpu, 50, "50 us") +
      panel(gnuplot, "woken late [us]", run.late, empty.late, 1e6 * summary.step, "one tick") +
      "unset multiplot\n";
  const std::string title =
      fmt::format("Punctuality of {} ticks of {} s", run.cpu.count(), summary.step);
  write_whole_file(file, file.extension() == ".png"
                             ? gnuplot.png("timing", 1100, 420, script)
                             : gnuplot.svg("timing", title, 1000, 380, script));
}

}  // namespace twinarm
