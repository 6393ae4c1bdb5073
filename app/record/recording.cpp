#include "app/record/recording.h"

#include <fmt/format.h>
#include <zlib.h>

#include <nlohmann/json.hpp>

namespace twinarm {
namespace {

// `min_bytes` per item limits the number of items to what the file can contain.
template <class T, class F>
void visit_all(StateArchive& memory, std::vector<T>& items, std::size_t min_bytes, F f) {
  memory.resize(items, min_bytes);
  for (T& item : items) f(item);
}
constexpr std::size_t kMinText = 8, kMinContact = 16 + 4 * sizeof(Vector3);  // [bytes]

void visit_contacts(StateArchive& memory, RecordedFrame& frame) {
  visit_all(memory, frame.contacts, kMinContact, [&](RecordedContact& contact) {
    memory.visit(contact.a, contact.b, contact.depth, contact.point, contact.normal, contact.force,
                 contact.couple);
  });
}

// Calls f(name, member) for all options of a run, in the order of the file.
template <class Run, class F>
void for_each_option(Run& run, const F& f) {
  f("model", run.robot.model);
  f("state", run.robot.state);
  f("gravity", run.robot.gravity);
  f("floating", run.robot.floating);
  f("friction", run.robot.friction);
  f("armature", run.robot.armature);
  f("strict", run.robot.strict);
  f("duration", run.duration);
  f("step", run.step);
  f("tolerance", run.tolerance);
  f("energy_bound", run.energy_bound);
  f("integrator", run.integrator);
  f("contact", run.contact);
}

// Those that are newer than version 2; missing in recordings made before.
template <class Run, class F>
void for_each_new_option(Run& run, const F& f) {
  f("density", run.robot.missing.density);
  f("min_mass", run.robot.missing.min_mass);
  f("budget", run.budget);
}

void visit_run(StateArchive& memory, RunSettings& run) {
  for_each_option(run, [&]<class T>(const char*, T& option) {
    if constexpr (std::is_same_v<T, std::filesystem::path>) {
      std::string text = option.string();
      memory.visit(text);
      option = text;
    } else if constexpr (std::is_same_v<T, std::optional<double>>) {
      bool given = option.has_value();
      double value = option.value_or(0);
      memory.visit(given, value);
      option = given ? std::optional(value) : std::nullopt;
    } else {
      memory.visit(option);
    }
  });
}

using Json = nlohmann::ordered_json;

// Fields of a frame: name, type, unit; [] after a count of 8 bytes.
Json frame_layout(std::uint32_t version) {
  const char* contacts =
      "contacts {a int32, b int32, depth float64 m, "
      "point float64[3] m, normal float64[3], force float64[3] N, couple float64[3] N m}[]";
  if (version < 4)
    return {"step int64",           "t float64 s",        "hash uint64",
            "values float64[]",     "pulls float64[][3]", contacts,
            "rows uint32[]",        "works float64[] J",  "momentum_rows uint32[]",
            "momenta float64[][3]", "memory uint8[]"};
  return {"step int64",    "t float64 s",           "q float64[]",
          "qd float64[]",  "values float64[]",      "pulls float64[][3]",
          contacts,        "works float64[] J",     "momenta float64[][3]",
          "rows uint32[]", "momentum_rows uint32[]"};
}

// Text that is not UTF-8 (paths, command lines) becomes a list of bytes.
Json text_json(const std::string& text) {
  try {
    (void)Json(text).dump();
    return text;
  } catch (const Json::exception&) {
    return std::vector<unsigned char>(text.begin(), text.end());
  }
}

std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  const auto bytes = value.get<std::vector<unsigned char>>();
  return {bytes.begin(), bytes.end()};
}

// Infinity becomes "inf".
Json number_json(const std::optional<double>& number) {
  if (!number) return nullptr;
  return std::isfinite(*number) ? Json(*number) : Json("inf");
}

std::optional<double> number_of(const Json& value) {
  if (value.is_null()) return {};
  return value.is_string() ? HUGE_VAL : value.get<double>();
}

template <class T, class F>
Json list_json(const std::vector<T>& items, F to_json) {
  Json list = Json::array();
  for (const T& item : items) list.push_back(to_json(item));
  return list;
}

template <class T, class F>
void read_list(const Json& list, std::vector<T>& items, F from_json) {
  if (!list.is_array()) throw std::runtime_error("a list of its header has another type");
  for (const Json& item : list) items.push_back(from_json(item));
}

Json run_json(const RunSettings& run) {
  Json json = Json::object();
  for_each_option(run, [&]<class T>(const char* name, const T& option) {
    if constexpr (std::is_same_v<T, bool>)
      json[name] = option;
    else if constexpr (std::is_same_v<T, std::optional<double>>)
      json[name] = number_json(option);
    else
      json[name] = text_json(option);
  });
  for_each_new_option(run, [&](const char* name, const std::optional<double>& option) {
    json[name] = number_json(option);
  });
  return json;
}

RunSettings run_of(const Json& json) {
  RunSettings run;
  for_each_option(run, [&]<class T>(const char* name, T& option) {
    if constexpr (std::is_same_v<T, bool>)
      json.at(name).get_to(option);
    else if constexpr (std::is_same_v<T, std::optional<double>>)
      option = number_of(json.at(name));
    else
      option = text_of(json.at(name));
  });
  for_each_new_option(run, [&](const char* name, std::optional<double>& option) {
    if (json.contains(name)) option = number_of(json.at(name));
  });
  return run;
}

RecordingHeader header_from(const Json& json, std::uint32_t version) {
  if (json.at("frame") != frame_layout(version))
    throw std::runtime_error("its frames have another layout than this program reads");
  RecordingHeader header;
  header.program = text_of(json.at("program"));
  read_list(json.at("command"), header.command, text_of);
  header.run = run_of(json.at("run"));
  header.integrator = text_of(json.at("integrator"));
  json.at("step").get_to(header.step);
  json.at("duration").get_to(header.duration);
  json.at("seed").get_to(header.seed);
  read_list(json.at("columns"), header.columns, [](const Json& column) {
    return RunColumn{text_of(column.at("name")), text_of(column.at("unit")), {}, {}};
  });
  read_list(json.at("couplings"), header.couplings, text_of);
  read_list(json.at("geometries"), header.geometries, text_of);
  read_list(json.at("files"), header.files, [](const Json& path) {
    return RecordedFile{text_of(path), {}};
  });
  return header;
}

}  // namespace

std::string name_of_pair(const std::vector<std::string>& geometries, int a, int b) {
  const auto name = [&](int id) {
    const auto i = static_cast<std::size_t>(id);
    return i < geometries.size() ? geometries[i] : std::to_string(id);
  };
  return name(a) + "-" + name(b);
}

std::vector<double> works_by_row(const RecordedFrame& frame, std::size_t rows) {
  std::vector<double> works(rows, 0);
  for (std::size_t i = 0; i < std::min(frame.rows.size(), frame.works.size()); ++i)
    if (frame.rows[i] < rows) works[frame.rows[i]] = frame.works[i];
  return works;
}

std::vector<double> momenta_by_row(const RecordedFrame& frame, std::size_t rows) {
  std::vector<double> momenta(6 * rows, 0);
  for (std::size_t i = 0; i < frame.momentum_rows.size(); ++i)
    for (std::size_t c = 0; c < 6; ++c)
      momenta.at(6 * frame.momentum_rows[i] + c) =
          frame.momenta.at(2 * i + c / 3)[static_cast<Eigen::Index>(c % 3)];
  return momenta;
}

std::uint64_t hash_of(const std::string& bytes, std::uint64_t basis) {
  std::uint64_t hash = basis;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

std::uint64_t hash_of(const RecordedFrame& frame, std::uint32_t version) {
  if (version < 4) return frame.hash;
  StateArchive state;
  double t = frame.t;
  std::vector<double> q = frame.q, qd = frame.qd;
  state.visit(t, q, qd);
  return hash_of(state.bytes());
}

std::uint32_t checksum(const char* bytes, std::size_t count) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const unsigned char*>(bytes), count));
}

void visit_version_2(StateArchive& memory, RecordingHeader& header) {
  memory.visit(header.program, header.command);
  visit_all(memory, header.files, 2 * kMinText,
            [&](RecordedFile& file) { memory.visit(file.path, file.bytes); });
  visit_run(memory, header.run);
  memory.visit(header.integrator, header.step, header.duration, header.seed);
  visit_all(memory, header.columns, 2 * kMinText,
            [&](RunColumn& column) { memory.visit(column.name, column.unit); });
  memory.visit(header.couplings, header.geometries);
}

void visit_version_3(StateArchive& memory, RecordedFrame& frame) {
  memory.visit(frame.step, frame.t, frame.hash, frame.values, frame.coupling_forces);
  visit_contacts(memory, frame);
  memory.visit(frame.rows, frame.works, frame.momentum_rows, frame.momenta, frame.memory);
}

void visit_motion(StateArchive& memory, RecordedFrame& frame) {
  memory.visit(frame.step, frame.t, frame.q, frame.qd, frame.values, frame.coupling_forces);
  visit_contacts(memory, frame);
}

// Words of 4 bytes last: FrameCoder codes words of 8.
void visit(StateArchive& memory, RecordedFrame& frame) {
  visit_motion(memory, frame);
  memory.visit(frame.works, frame.momenta, frame.rows, frame.momentum_rows);
}

std::string header_text(const RecordingHeader& header) {
  const Json json{
      {"program", text_json(header.program)},
      {"command", list_json(header.command, text_json)},
      {"run", run_json(header.run)},
      {"integrator", text_json(header.integrator)},
      {"step", header.step},
      {"duration", header.duration},
      {"seed", header.seed},
      {"columns",
       list_json(header.columns,
                 [](const RunColumn& column) {
                   return Json{{"name", text_json(column.name)}, {"unit", text_json(column.unit)}};
                 })},
      {"couplings", list_json(header.couplings, text_json)},
      {"geometries", list_json(header.geometries, text_json)},
      {"frame", frame_layout(recording_format::kVersion)},
      {"files",
       list_json(header.files, [](const RecordedFile& file) { return text_json(file.path); })}};
  return json.dump(1);
}

// Rejects headers that no run writes, before memory is allocated for them.
RecordingHeader parse_header(std::string_view text, std::uint32_t version) try {
  constexpr std::size_t kMaxBytes = 32u << 20;
  constexpr int kMaxDepth = 8;
  if (text.size() > kMaxBytes) throw std::runtime_error("its header has more than 32 MiB");
  const auto check_depth = [](int depth, Json::parse_event_t event, const Json&) {
    const bool opens =
        event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    if (opens && depth >= kMaxDepth) throw std::runtime_error("its header is nested too deeply");
    return true;
  };
  return header_from(Json::parse(text, check_depth), version);
} catch (const Json::parse_error& error) {
  throw std::runtime_error(fmt::format("its header is not JSON: error at byte {}", error.byte));
} catch (const Json::exception& error) {
  throw std::runtime_error(std::string("its header cannot be read: ") + error.what());
}

}  // namespace twinarm
