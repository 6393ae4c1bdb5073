// `twinarm replay`: the same bits from a recorded step on, or a fork beside its recording.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <array>

#include "app/command/command.h"
#include "app/command/parser/shared_options.h"
#include "app/data/json_writer.h"
#include "app/record/branch_view.h"
#include "app/support/files.h"

namespace twinarm {
namespace {

struct ReplayOptions {
  std::filesystem::path recording;
  std::optional<double> from;  // [s]; left out: the first that is recorded
  std::vector<std::string> changes;
  std::filesystem::path plot;  // SVG; empty: none
  bool json = false;
};

void add_options(CLI::App& command, ReplayOptions& options) {
  add_file_option(command, "recording", options.recording, "of `twinarm simulate --record`")
      ->required();
  command.add_option("--from", options.from, "seconds; the start if not given");
  command.add_option("--set", options.changes, "PATH=VALUE of the scene, for a fork")
      ->allow_extra_args(false);
  add_file_option(command, "--plot", options.plot, "an SVG of both branches");
  add_json_option(command, options.json);
}

constexpr int kDiffers = 1;

void write_branch(JsonWriter& json, const char* name, const Recording& recording,
                  const Replay& replay, bool forked) {
  const auto& columns = recording.header().columns;
  std::vector<double> times;
  std::vector<std::vector<double>> values(columns.size());
  for (std::size_t n = 0; n < replay.frames.size(); ++n) {
    times.push_back(replay.frames[n].t);
    const RecordedFrame frame = forked ? replay.frames[n] : recording.frame(replay.first + n);
    for (std::size_t c = 0; c < columns.size(); ++c) values[c].push_back(frame.values[c]);
  }
  const auto write_values = [&] {
    for (std::size_t c = 0; c < columns.size(); ++c) json.put(columns[c].with_unit(), values[c]);
  };
  json.object({{"name", name}, {"t", times}, {"values", [&] { json.object(write_values); }}});
}

void write_ledgers(JsonWriter& json, const ComparedBalances& ledgers) {
  const auto write_rows = [&](const auto& rows) {
    return [&] {
      for (const auto& row : rows)
        json.key(row.name).object({{"recorded", row.recorded}, {"fork", row.fork}});
    };
  };
  json.key("ledger").object(write_rows(ledgers.works));
  json.key("momentum").object(write_rows(ledgers.momenta));
}

bool is_same(const Replay& exact) {
  return exact.hash == exact.hash_again && exact.equal == exact.compared;
}

void print_replay_json(const Recording& recording, const Replay& exact, const Replay* fork,
                       const std::vector<std::string>& changes) {
  const auto write = [&](JsonWriter& json) {
    json.members({{"from", exact.from},
                  {"to", exact.to},
                  {"step", exact.step},
                  {"hash", fmt::format("{:016x}", exact.hash)},
                  {"hash_again", fmt::format("{:016x}", exact.hash_again)},
                  {"compared", exact.compared},
                  {"equal", exact.equal},
                  {"bit_exact", is_same(exact)}});
    if (exact.first_different >= 0) json.put("first_different", exact.first_different);
    json.members({{"set", changes}, {"notes", recording.notes()}});
    if (!fork) return;
    json.key("branches").list(std::array{false, true}, [&](bool forked) {
      write_branch(json, forked ? "fork" : "recorded", recording, *fork, forked);
    });
    write_ledgers(json, compared_ledgers(exact, *fork));
  };
  fmt::print("{}\n", json_text(write));
}

int run_replay(const ReplayOptions& options) {
  std::vector<Change> changes;
  for (const std::string& text : options.changes) changes.push_back(parse_change(text));
  if (!options.plot.empty() && changes.empty())
    throw InputError(
        {{"", 0, "--plot", "there is one branch only", "give --set too", "option.conflict"}});
  if (!options.plot.empty()) check_plot(options.plot);
  const Recording recording(options.recording);
  for (const std::string& note : recording.notes()) say("twinarm: {}\n", note);
  const std::size_t first = options.from ? recording.at(*options.from, "--from") : 0;
  const Replay exact = replay(recording, first, {});
  std::optional<Replay> fork;
  if (!changes.empty()) fork = replay(recording, first, changes);
  const bool same = is_same(exact);
  if (options.json) {
    print_replay_json(recording, exact, fork ? &*fork : nullptr, options.changes);
  } else {
    fmt::print("taken up at t = {:.9g} s, step {}: hash {:016x}, again {:016x}\n", exact.from,
               exact.step, exact.hash, exact.hash_again);
    fmt::print(
        "{} of {} recorded frames after it have the same bits{}\n", exact.equal, exact.compared,
        same ? ""
             : fmt::format("; the first that differs is at t = {:.9g} s", exact.first_different));
    if (fork) print_fork(recording, exact, *fork);
  }
  if (fork && !options.plot.empty())
    draw_fork(recording, exact, *fork, options.changes, options.plot);
  return same ? 0 : kDiffers;
}

}  // namespace

Command replay_command() {
  return {100, "replay",
          "Run on from a recorded step: the same bits; or, with --set, a fork\n\n"
          "Example:  twinarm replay out/run.twinrec --from 0.5 --set coupling.stiffness=800",
          add_options, run_replay};
}

}  // namespace twinarm
