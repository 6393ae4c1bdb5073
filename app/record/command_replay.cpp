// `twinarm replay`: the same bits from a recorded step on, or a fork beside its recording.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands.h"
#include "app/json_writer.h"
#include "app/record/replay.h"
#include "app/study/gnuplot.h"
#include "app/text_table.h"

namespace twinarm {
namespace {

constexpr int kDiffers = 1;
constexpr std::size_t kTableRows = 20, kTableColumns = 4;

// Which values part most, the most first; quaternions and all else alike.
std::vector<std::size_t> parted(const Recording& recording, const Replay& fork) {
  std::vector<double> most(recording.header().columns.size());
  for (std::size_t n = 0; n < fork.frames.size(); ++n) {
    const RecordedFrame recorded = recording.frame(fork.first + n);
    for (std::size_t c = 0; c < most.size(); ++c)
      most[c] = std::max(most[c], std::abs(fork.frames[n].values[c] - recorded.values[c]));
  }
  std::vector<std::size_t> order;
  for (std::size_t c = 0; c < most.size(); ++c)
    if (recording.header().columns[c].name.starts_with("q/") ||
        recording.header().columns[c].name.starts_with("links/"))
      order.push_back(c);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return most[a] > most[b]; });
  return order;
}

std::string with_unit(const RecordedColumn& column) {
  return column.name + "[" + column.unit + "]";
}

void print_branches(const Recording& recording, const Replay& fork) {
  std::vector<std::size_t> columns = parted(recording, fork);
  columns.resize(std::min(columns.size(), kTableColumns));
  std::vector<std::string> headings{"t [s]"};
  for (const std::size_t c : columns)
    for (const char* branch : {"recorded ", "fork "})
      headings.push_back(branch + with_unit(recording.header().columns[c]));
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

void draw_branches(const Recording& recording, const Replay& fork,
                   const std::filesystem::path& file) {
  const std::vector<std::size_t> columns = parted(recording, fork);
  if (columns.empty()) return;
  const RecordedColumn& column = recording.header().columns[columns.front()];
  std::vector<double> t, first, second;
  for (std::size_t n = 0; n < fork.frames.size(); ++n) {
    const RecordedFrame recorded = recording.frame(fork.first + n);
    t.push_back(recorded.t);
    first.push_back(recorded.values[columns.front()]);
    second.push_back(fork.frames[n].values[columns.front()]);
  }
  const std::filesystem::path folder = file.parent_path().empty() ? "." : file.parent_path();
  Gnuplot gnuplot(folder);
  const std::string script = fmt::format(
      "set xlabel 'time [s]'\nset ylabel {}\nplot {} with lines lw 4 lc '{}' title 'recorded', {} "
      "with lines lw 1.5 lc '{}' title 'fork'\n",
      in_quotes(column.name + " [" + column.unit + "]"), gnuplot.curve(t, first), palette::kvr,
      gnuplot.curve(t, second), palette::dvr);
  gnuplot.draw(file.stem().string(), "Recorded run and fork: " + column.name, 900, 420, script);
}

void write_branch(JsonWriter& json, const char* name, const Recording& recording,
                  const Replay& replay, bool forked) {
  json.begin_object();
  json.key("name").text(name);
  json.key("t").begin_array();
  for (const RecordedFrame& frame : replay.frames) json.number(frame.t);
  json.end_array();
  json.key("values").begin_object();
  const auto& columns = recording.header().columns;
  std::vector<std::vector<double>> values(columns.size());
  for (std::size_t n = 0; n < replay.frames.size(); ++n) {
    const RecordedFrame frame = forked ? replay.frames[n] : recording.frame(replay.first + n);
    for (std::size_t c = 0; c < columns.size(); ++c) values[c].push_back(frame.values[c]);
  }
  for (std::size_t c = 0; c < columns.size(); ++c)
    json.key(with_unit(columns[c])).numbers(values[c]);
  json.end_object();
  json.end_object();
}

void print_replay_json(const Recording& recording, const Replay& exact, const Replay* fork,
                       const std::vector<std::string>& changes) {
  JsonWriter json;
  json.begin_object();
  json.key("from").number(exact.from);
  json.key("to").number(exact.to);
  json.key("step").count(exact.step);
  json.key("hash").text(fmt::format("{:016x}", exact.hash));
  json.key("hash_again").text(fmt::format("{:016x}", exact.hash_again));
  json.key("compared").count(static_cast<long>(exact.compared));
  json.key("equal").count(static_cast<long>(exact.equal));
  json.key("bit_exact").boolean(exact.hash == exact.hash_again && exact.equal == exact.compared);
  if (exact.first_different >= 0) json.key("first_different").number(exact.first_different);
  json.key("set").texts(changes);
  json.key("notes").texts(recording.notes());
  if (fork) {
    json.key("branches").begin_array();
    write_branch(json, "recorded", recording, *fork, false);
    write_branch(json, "fork", recording, *fork, true);
    json.end_array();
  }
  json.end_object();
  fmt::print("{}\n", json.str());
}

}  // namespace

int run_replay(const ReplayOptions& options) {
  std::vector<Change> changes;
  for (const std::string& text : options.changes) changes.push_back(parse_change(text));
  if (!options.plot.empty() && (changes.empty() || options.plot.extension() != ".svg"))
    throw InputError(
        {{"", 0, "--plot", changes.empty() ? "there is one branch only" : "is drawn as SVG",
          changes.empty() ? "give --set too" : "give a name that ends in .svg"}});
  const Recording recording(options.recording);
  for (const std::string& note : recording.notes()) fmt::print(stderr, "twinarm: {}\n", note);
  const std::size_t first = recording.at(options.from, "--from");
  const Replay exact = replay(recording, first, {});
  std::optional<Replay> fork;
  if (!changes.empty()) fork = replay(recording, first, changes);
  const bool same = exact.hash == exact.hash_again && exact.equal == exact.compared;
  if (options.json) {
    print_replay_json(recording, exact, fork ? &*fork : nullptr, options.changes);
  } else {
    fmt::print("taken up at t = {} s, step {}: hash {:016x}, again {:016x}\n", exact.from,
               exact.step, exact.hash, exact.hash_again);
    fmt::print(
        "{} of {} recorded frames after it have the same bits{}\n", exact.equal, exact.compared,
        same ? "" : fmt::format("; the first that differs is at t = {} s", exact.first_different));
    if (fork) print_branches(recording, *fork);
  }
  if (fork && !options.plot.empty()) draw_branches(recording, *fork, options.plot);
  return same ? 0 : kDiffers;
}

}  // namespace twinarm
