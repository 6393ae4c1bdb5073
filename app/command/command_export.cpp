// `twinarm export`: a recording as CSV or JSON, or as a page (app/web).
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>

#include "app/command/commands.h"
#include "app/command/export_page.h"
#include "app/data/json_writer.h"
#include "app/record/recording_reader.h"
#include "app/support/interrupt.h"
#include "app/support/streams.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

using GeometryPair = std::pair<int, int>;

std::string name_of_pair(const RecordingHeader& header, const GeometryPair& pair) {
  const auto name = [&](int id) {
    const auto i = static_cast<std::size_t>(id);
    return i < header.geometries.size() ? header.geometries[i] : std::to_string(id);
  };
  return "contact/" + name(pair.first) + "-" + name(pair.second);
}

std::string in_csv(const std::string& name) {
  if (name.find_first_of(",\"\n") == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

// The pairs that touch in any frame, whose forces have columns.
std::vector<GeometryPair> pairs_of(const Recording& recording) {
  std::vector<GeometryPair> pairs;
  for (std::size_t n = 0; n < recording.size(); ++n)
    for (const RecordedContact& c : recording.frame(n).contacts) pairs.emplace_back(c.a, c.b);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

std::string recorded_csv_header(const Recording& recording,
                                const std::vector<GeometryPair>& pairs) {
  const RecordingHeader& header = recording.header();
  std::string line = "t[s],step[1]";
  const auto add = [&](const std::string& name) { line += "," + in_csv(name); };
  for (const RecordedColumn& column : header.columns) add(column.name + "[" + column.unit + "]");
  for (const std::string& coupling : header.couplings)
    for (const char* axis : {"x", "y", "z"})
      add("coupling/" + coupling + "/" + axis + "[N or N m]");
  for (const GeometryPair& pair : pairs)
    for (const char* axis : {"x", "y", "z"}) add(name_of_pair(header, pair) + "/" + axis + "[N]");
  for (const std::string& row : recording.rows()) add("ledger/" + row + "[J]");
  for (const std::string& row : recording.momentum_rows())
    for (const char* part :
         {"/x[N s]", "/y[N s]", "/z[N s]", "/about_x[N m s]", "/about_y[N m s]", "/about_z[N m s]"})
      add("momentum/" + row + part);
  return line + ",hash[1]";
}

void print_recording_csv(const Recording& recording) {
  const std::vector<GeometryPair> pairs = pairs_of(recording);
  fmt::print("{}\n", recorded_csv_header(recording, pairs));
  for (std::size_t n = 0; n < recording.size(); ++n) {
    check_interrupt();
    const RecordedFrame frame = recording.frame(n);
    std::string line = number_text(frame.t) + "," + std::to_string(frame.step);
    const auto add = [&](double value) { line += "," + number_text(value); };
    for (const double value : frame.values) add(value);
    for (const Vector3& pull : frame.pulls)
      for (const double component : pull) add(component);
    for (const GeometryPair& pair : pairs) {
      Vector3 force = Vector3::Zero();
      for (const RecordedContact& c : frame.contacts)
        if (GeometryPair(c.a, c.b) == pair) force += c.force;
      for (const double component : force) add(component);
    }
    std::vector<double> works(recording.rows().size());
    for (std::size_t i = 0; i < frame.rows.size(); ++i) works.at(frame.rows[i]) = frame.works[i];
    for (const double work : works) add(work);
    std::vector<Vector3> momenta(2 * recording.momentum_rows().size(), Vector3::Zero());
    for (std::size_t i = 0; i < frame.momentum_rows.size(); ++i)
      for (std::size_t part = 0; part < 2; ++part)
        momenta.at(2 * frame.momentum_rows[i] + part) = frame.momenta.at(2 * i + part);
    for (const Vector3& momentum : momenta)
      for (const double component : momentum) add(component);
    fmt::print("{},{:016x}\n", line, frame.hash);
  }
}

void write_recorded_contact(JsonWriter& json, const RecordingHeader& header,
                            const RecordedContact& c) {
  json.begin_object();
  json.key("pair").text(name_of_pair(header, {c.a, c.b}));
  json.key("depth").number(c.depth);
  json.key("point").vector(c.point);
  json.key("normal").vector(c.normal);
  json.key("force").vector(c.force);
  json.key("couple").vector(c.couple);
  json.end_object();
}

void write_recorded_frame(JsonWriter& json, const Recording& recording,
                          const RecordedFrame& frame) {
  const RecordingHeader& header = recording.header();
  json.begin_object();
  json.key("t").number(frame.t);
  json.key("step").count(frame.step);
  json.key("hash").text(fmt::format("{:016x}", frame.hash));
  json.key("values").numbers(frame.values);
  json.key("couplings").begin_object();
  for (std::size_t c = 0; c < frame.pulls.size(); ++c)
    json.key(header.couplings.at(c)).vector(frame.pulls[c]);
  json.end_object();
  json.key("contacts").begin_array();
  for (const RecordedContact& c : frame.contacts) write_recorded_contact(json, header, c);
  json.end_array();
  json.key("ledger").begin_object();
  for (std::size_t i = 0; i < frame.rows.size(); ++i)
    json.key(recording.rows().at(frame.rows[i])).number(frame.works[i]);
  json.end_object();
  json.key("momentum").begin_object();
  for (std::size_t i = 0; i < frame.momentum_rows.size(); ++i) {
    json.key(recording.momentum_rows().at(frame.momentum_rows[i])).begin_object();
    json.key("linear").vector(frame.momenta.at(2 * i));
    json.key("angular").vector(frame.momenta.at(2 * i + 1));
    json.end_object();
  }
  json.end_object();
  json.end_object();
}

void print_recording_json(const Recording& recording) {
  const RecordingHeader& header = recording.header();
  JsonWriter json;
  json.begin_object();
  json.key("program").text(header.program);
  json.key("format").count(recording_format::kVersion);
  json.key("command").texts(header.command);
  json.key("model").text(header.options.robot.model.string());
  json.key("files").begin_array();
  for (const RecordedFile& file : header.files) json.text(file.path);
  json.end_array();
  json.key("integrator").text(header.integrator);
  json.key("step").number(header.step);
  json.key("duration").number(header.duration);
  json.key("seed").count(header.seed);
  json.key("end").text(recording.end());
  json.key("notes").texts(recording.notes());
  json.key("alarms").texts(recording.alarms());
  json.key("units").begin_object();
  json.key("t").text("s");
  json.key("ledger").text("J");
  json.key("momentum").begin_object();
  json.key("linear").text("N s");
  json.key("angular").text("N m s");
  json.end_object();
  json.key("force").text("N");
  json.key("couple").text("N m");
  json.key("couplings").text("N or N m");
  json.key("depth").text("m");
  json.end_object();
  json.key("columns").begin_array();
  for (const RecordedColumn& column : header.columns) {
    json.begin_object();
    json.key("name").text(column.name);
    json.key("unit").text(column.unit);
    json.end_object();
  }
  json.end_array();
  json.key("frames").begin_array();
  for (std::size_t n = 0; n < recording.size(); ++n) {
    check_interrupt();
    write_recorded_frame(json, recording, recording.frame(n));
  }
  json.end_array();
  json.end_object();
  fmt::print("{}\n", json.str());
}

}  // namespace

int run_export(const ExportOptions& options) {
  if (!options.page.empty()) return export_page(options);
  if (options.json == options.csv)
    throw InputError({{"", 0, "--csv, --json", options.json ? "both are given" : "neither is given",
                       "give one of them, or the name of a page", "option.conflict"}});
  const Recording recording(options.recording);
  for (const std::string& note : recording.notes()) say("twinarm: {}\n", note);
  options.json ? print_recording_json(recording) : print_recording_csv(recording);
  return 0;
}

}  // namespace twinarm
