// `twinarm export`: converts a recording to CSV, JSON or an HTML page (app/web).

#include <fmt/format.h>

#include <algorithm>

#include "app/command/command.h"
#include "app/data/json_writer.h"
#include "app/page/pages.h"
#include "app/record/recording_reader.h"
#include "app/support/files.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

using GeometryPair = std::pair<int, int>;

// The pairs in contact in any frame; each has columns for its force.
std::vector<GeometryPair> pairs_of(const Recording& recording) {
  std::vector<GeometryPair> pairs;
  for (std::size_t n = 0; n < recording.size(); ++n)
    for (const RecordedContact& c : recording.frame(n).contacts) pairs.emplace_back(c.a, c.b);
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

std::string contact_name(const RecordingHeader& header, const GeometryPair& pair) {
  return "contact/" + name_of_pair(header.geometries, pair.first, pair.second);
}

std::vector<std::string> csv_header(const Recording& recording,
                                    const std::vector<GeometryPair>& pairs) {
  const RecordingHeader& header = recording.header();
  std::vector<std::string> names{"t[s]", "step[1]"};
  const auto add_axes = [&](const std::string& name, const char* unit) {
    for (const char* axis : {"/x", "/y", "/z"}) names.push_back(name + axis + unit);
  };
  for (const RunColumn& column : header.columns) names.push_back(column.with_unit());
  for (const std::string& coupling : header.couplings)
    add_axes("coupling/" + coupling, "[N or N m]");
  for (const GeometryPair& pair : pairs) add_axes(contact_name(header, pair), "[N]");
  for (const std::string& row : recording.rows()) names.push_back("energy_balance/" + row + "[J]");
  for (const std::string& row : recording.momentum_rows()) {
    add_axes("momentum/" + row, "[N s]");
    for (const char* axis : {"/about_x", "/about_y", "/about_z"})
      names.push_back("momentum/" + row + axis + "[N m s]");
  }
  names.push_back("hash[1]");
  return names;
}

// In the order of csv_header(), without t, step and hash.
std::vector<double> csv_values(const Recording& recording, const RecordedFrame& frame,
                               const std::vector<GeometryPair>& pairs) {
  std::vector<double> values = frame.values;
  const auto add = [&](const auto& several) {
    values.insert(values.end(), several.begin(), several.end());
  };
  for (const Vector3& force : frame.coupling_forces) add(force);
  for (const GeometryPair& pair : pairs) {
    Vector3 force = Vector3::Zero();
    for (const RecordedContact& c : frame.contacts)
      if (GeometryPair(c.a, c.b) == pair) force += c.force;
    add(force);
  }
  add(works_by_row(frame, recording.rows().size()));
  add(momenta_by_row(frame, recording.momentum_rows().size()));
  return values;
}

void write_momentum(JsonWriter& json, const Recording& recording, const RecordedFrame& frame) {
  for (std::size_t i = 0; i < frame.momentum_rows.size(); ++i)
    json.key(recording.momentum_rows().at(frame.momentum_rows[i]))
        .object({{"linear", frame.momenta.at(2 * i)}, {"angular", frame.momenta.at(2 * i + 1)}});
}

void write_frame(JsonWriter& json, const Recording& recording, const RecordedFrame& frame) {
  const RecordingHeader& header = recording.header();
  const auto write_contact = [&](const RecordedContact& c) {
    json.object({{"pair", contact_name(header, {c.a, c.b})},
                 {"depth", c.depth},
                 {"point", c.point},
                 {"normal", c.normal},
                 {"force", c.force},
                 {"moment", c.couple}});
  };
  json.object([&] {
    json.members({{"t", frame.t},
                  {"step", frame.step},
                  {"hash", fmt::format("{:016x}", hash_of(frame, recording.version()))},
                  {"values", frame.values}});
    json.key("couplings").object([&] {
      for (std::size_t c = 0; c < frame.coupling_forces.size(); ++c)
        json.put(header.couplings.at(c), frame.coupling_forces[c]);
    });
    json.key("contacts").list(frame.contacts, write_contact);
    json.key("energy_balance").object([&] {
      for (std::size_t i = 0; i < frame.rows.size(); ++i)
        json.put(recording.rows().at(frame.rows[i]), frame.works[i]);
    });
    json.key("momentum").object([&] { write_momentum(json, recording, frame); });
  });
}

void write_header(JsonWriter& json, const Recording& recording) {
  const RecordingHeader& header = recording.header();
  json.members({{"program", header.program},
                {"format", recording.version()},
                {"command", header.command},
                {"model", header.run.robot.model.string()}});
  json.key("files").list(header.files, [&](const RecordedFile& file) { json.text(file.path); });
  json.members({{"integrator", header.integrator},
                {"step", header.step},
                {"duration", header.duration},
                {"seed", header.seed},
                {"end", recording.end()},
                {"notes", recording.notes()},
                {"alarms", recording.alarms()}});
  json.key("units").object([&] {
    json.members({{"t", "s"}, {"energy_balance", "J"}});
    json.key("momentum").object({{"linear", "N s"}, {"angular", "N m s"}});
    json.members({{"force", "N"}, {"moment", "N m"}, {"couplings", "N or N m"}, {"depth", "m"}});
  });
  json.key("columns").list(header.columns, [&](const RunColumn& column) {
    json.object({{"name", column.name}, {"unit", column.unit}});
  });
}

void print_recording_csv(const Recording& recording) {
  const std::vector<GeometryPair> pairs = pairs_of(recording);
  fmt::print("{}\n", csv_line(csv_header(recording, pairs)));
  for (std::size_t n = 0; n < recording.size(); ++n) {
    check_interrupt();
    const RecordedFrame frame = recording.frame(n);
    fmt::print("{},{},{},{:016x}\n", csv_line(std::vector{frame.t}), frame.step,
               csv_line(csv_values(recording, frame, pairs)), hash_of(frame, recording.version()));
  }
}

void print_recording_json(const Recording& recording) {
  for (std::size_t n = 0; n < recording.size(); ++n) {  // refuses damaged ones before it prints
    check_interrupt();
    recording.frame(n);
  }
  const auto write = [&](JsonWriter& json) {
    write_header(json, recording);
    json.key("frames").begin_array();
    for (std::size_t n = 0; n < recording.size(); ++n) {
      check_interrupt();
      write_frame(json, recording, recording.frame(n));
      fmt::print("{}", json.take());
    }
    json.end_array();
  };
  fmt::print("{}\n", answer_text(write));
}

struct ExportOptions {
  std::filesystem::path recording;
  std::filesystem::path page;  // HTML file; empty: CSV or JSON on stdout
  bool json = false, csv = false;
};

void add_options(const OptionAdder& add, ExportOptions& options) {
  add.input("recording", options.recording, ".twinrec",
            "recording (.twinrec), as `twinarm simulate --record` writes it")
      ->required();
  add.output("page", options.page, ".html",
             "write one HTML file: animation, plots, energy balance, settings");
  add.group("Output on stdout");
  add.json(options.json);
  add("--csv", options.csv, "print one CSV row per frame");
}

int export_page(const ExportOptions& options) {
  const std::string file = options.page.string();
  if (options.csv)
    throw InputError("--csv", "cannot be combined with a page", "give one of them",
                     "option.conflict");
  const ReplayPage page = replay_page(options.recording);
  write_whole_file(options.page, page.html);
  if (!options.json) {
    fmt::print("wrote {}: {} frames, {:.3g} per second, {:.2f} MB\n", file, page.frames, page.rate,
               1e-6 * static_cast<double>(page.html.size()));
    return 0;
  }
  fmt::print("{}\n", answer_text({{"file", file},
                                  {"frames", page.frames},
                                  {"rate", page.rate},
                                  {"bytes", page.html.size()}}));
  return 0;
}

int run_export(const ExportOptions& options) {
  if (!options.page.empty()) return export_page(options);
  if (options.json == options.csv)
    throw InputError("--csv, --json", options.json ? "both are given" : "neither is given",
                     "give one of them, or the name of a page", "option.conflict");
  const Recording recording(options.recording);
  for (const std::string& note : recording.notes()) print_error("twinarm: {}\n", note);
  options.json ? print_recording_json(recording) : print_recording_csv(recording);
  return 0;
}

}  // namespace

Command export_command() {
  return {90, "export",
          "Convert a recording to CSV or JSON, or to an HTML page that replays it\n\n"
          "Examples:\n"
          "  twinarm export out/run.twinrec out/run.html\n"
          "  twinarm export out/run.twinrec --csv > out/run.csv",
          add_options, run_export};
}

}  // namespace twinarm
