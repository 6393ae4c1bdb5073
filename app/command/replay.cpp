// `twinarm replay`: replays a recorded run bit by bit; or computes a branch with changed
// parameters.
#include <fmt/format.h>
#include <array>

#include "app/command/command.h"
#include "app/data/json_writer.h"
#include "app/plot/gnuplot.h"
#include "app/record/record_run.h"
#include "app/support/files.h"

namespace twinarm {
namespace {

struct ReplayOptions {
  std::filesystem::path recording;
  std::optional<double> from;  // [s]; default: the first frame
  std::vector<std::string> changes;
  std::filesystem::path plot;  // SVG; empty: none
  bool json = false;
};

void add_options(const OptionAdder& add, ReplayOptions& options) {
  add.input("recording", options.recording, ".twinrec",
            "recording (.twinrec), as `twinarm simulate --record` writes it")
      ->required();
  add.group("Branch");
  add("--from", options.from, "time of the first step [s]; default: the start");
  add("--set", options.changes, "PATH=VALUE: change this parameter of the scene; may be repeated")
      ->allow_extra_args(false);
  add.group("Output");
  add.output("--plot", options.plot, ".svg", "write an SVG of recording and branch (with --set)");
  add.json(options.json);
}

constexpr int kDiffers = 1;

void write_branch(JsonWriter& json, const char* name, const Recording& recording,
                  const Replay& replay, bool is_branch) {
  const auto& columns = recording.header().columns;
  std::vector<double> times;
  std::vector<std::vector<double>> values(columns.size());
  for (std::size_t n = 0; n < replay.frames.size(); ++n) {
    times.push_back(replay.frames[n].t);
    const RecordedFrame frame = is_branch ? replay.frames[n] : recording.frame(replay.first + n);
    for (std::size_t c = 0; c < columns.size(); ++c) values[c].push_back(frame.values[c]);
  }
  const auto write_values = [&] {
    for (std::size_t c = 0; c < columns.size(); ++c) json.put(columns[c].with_unit(), values[c]);
  };
  json.object({{"name", name}, {"t", times}, {"values", [&] { json.object(write_values); }}});
}

void write_balances(JsonWriter& json, const ComparedBalances& balances) {
  const auto write_rows = [&](const auto& rows) {
    return [&] {
      for (const auto& row : rows)
        json.key(row.name).object({{"recorded", row.recorded}, {"branch", row.branch}});
    };
  };
  json.key("energy_balance").object(write_rows(balances.works));
  json.key("momentum").object(write_rows(balances.momenta));
}

bool is_same(const Replay& exact) {
  return exact.hash == exact.hash_again && exact.equal == exact.compared;
}

void print_replay_json(const Recording& recording, const Replay& exact, const Replay* branch,
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
    if (!branch) return;
    json.key("branches").list(std::array{false, true}, [&](bool is_branch) {
      write_branch(json, is_branch ? "branch" : "recorded", recording, *branch, is_branch);
    });
    write_balances(json, compared_balances(exact, *branch));
  };
  fmt::print("{}\n", answer_text(write));
}

int run_replay(const ReplayOptions& options) {
  std::vector<Change> changes;
  for (const std::string& text : options.changes) changes.push_back(parse_change(text));
  if (!options.plot.empty() && changes.empty())
    throw InputError("--plot", "there is no branch to draw", "give --set too", "option.conflict");
  if (!options.plot.empty()) require_gnuplot();
  const Recording recording(options.recording);
  for (const std::string& note : recording.notes()) print_error("twinarm: {}\n", note);
  const std::size_t first = options.from ? recording.at(*options.from, "--from") : 0;
  const Replay exact = replay(recording, first, {});
  std::optional<Replay> branch;
  if (!changes.empty()) branch = replay(recording, first, changes);
  const bool same = is_same(exact);
  if (branch && !options.plot.empty())
    draw_branch(recording, exact, *branch, options.changes, options.plot);
  if (options.json) {
    print_replay_json(recording, exact, branch ? &*branch : nullptr, options.changes);
  } else {
    fmt::print(
        "resumed at t = {:.9g} s, step {}: state hash recorded {:016x}, recomputed {:016x}\n",
        exact.from, exact.step, exact.hash, exact.hash_again);
    fmt::print(
        "{} of {} later frames have the same bits{}\n", exact.equal, exact.compared,
        same ? "" : fmt::format("; first difference at t = {:.9g} s", exact.first_different));
    if (branch) print_branch(recording, exact, *branch);
  }
  if (branch && !options.plot.empty()) print_wrote({options.plot}, options.json);
  return same ? 0 : kDiffers;
}

}  // namespace

Command replay_command() {
  return {100, "replay",
          "Replay from a recorded step and verify bitwise; with --set, re-run with changed "
          "parameters\n\n"
          "Examples:\n"
          "  twinarm replay out/run.twinrec\n"
          "  twinarm replay out/run.twinrec --from 0.5 --set coupling.stiffness=800 --plot b.svg",
          add_options, run_replay};
}

}  // namespace twinarm
