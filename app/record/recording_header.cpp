// The header of a recording as JSON.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/record/recording.h"

namespace twinarm {
namespace {

using Json = nlohmann::ordered_json;

// Of frames, in their order: name and type, [] with a count of 8 bytes before it.
constexpr std::array kFrameLayout{
    "step int64",
    "t float64 s",
    "hash uint64",
    "values float64[]",
    "pulls float64[][3]",
    "contacts {a int32, b int32, depth float64 m, "
    "point float64[3] m, normal float64[3], force float64[3] N, couple float64[3] N m}[]",
    "rows uint32[]",
    "works float64[] J",
    "momentum_rows uint32[]",
    "momenta float64[][3]",
    "memory uint8[]"};

// Paths and command lines may be bytes that are no UTF-8: then a list of them.
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

// JSON has no number for infinity.
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
  if (!list.is_array()) throw std::runtime_error("its header has no list where one must be");
  for (const Json& item : list) items.push_back(from_json(item));
}

Json run_json(const RecordedRun& run) {
  return {{"model", text_json(run.model.string())},
          {"state", text_json(run.state.string())},
          {"gravity", text_json(run.gravity)},
          {"floating", run.floating},
          {"friction", run.friction},
          {"armature", run.armature},
          {"strict", run.strict},
          {"duration", number_json(run.duration)},
          {"step", number_json(run.step)},
          {"tolerance", number_json(run.tolerance)},
          {"energy_bound", number_json(run.energy_bound)},
          {"integrator", text_json(run.integrator)},
          {"contact", text_json(run.contact)}};
}

RecordedRun run_of(const Json& json) {
  RecordedRun run;
  run.model = text_of(json.at("model"));
  run.state = text_of(json.at("state"));
  run.gravity = text_of(json.at("gravity"));
  json.at("floating").get_to(run.floating);
  json.at("friction").get_to(run.friction);
  json.at("armature").get_to(run.armature);
  json.at("strict").get_to(run.strict);
  run.duration = number_of(json.at("duration"));
  run.step = number_of(json.at("step"));
  run.tolerance = number_of(json.at("tolerance"));
  run.energy_bound = number_of(json.at("energy_bound"));
  run.integrator = text_of(json.at("integrator"));
  run.contact = text_of(json.at("contact"));
  return run;
}

RecordingHeader header_from(const Json& json) {
  if (json.at("frame") != Json(kFrameLayout))
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
    return RecordedColumn{text_of(column.at("name")), text_of(column.at("unit"))};
  });
  read_list(json.at("couplings"), header.couplings, text_of);
  read_list(json.at("geometries"), header.geometries, text_of);
  read_list(json.at("files"), header.files, [](const Json& path) {
    return RecordedFile{text_of(path), {}};
  });
  return header;
}

}  // namespace

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
                 [](const RecordedColumn& column) {
                   return Json{{"name", text_json(column.name)}, {"unit", text_json(column.unit)}};
                 })},
      {"couplings", list_json(header.couplings, text_json)},
      {"geometries", list_json(header.geometries, text_json)},
      {"frame", kFrameLayout},
      {"files",
       list_json(header.files, [](const RecordedFile& file) { return text_json(file.path); })}};
  return json.dump(1);
}

// What no run writes is refused before it is given the memory.
RecordingHeader parse_header(std::string_view text) try {
  constexpr std::size_t kMaxBytes = 32u << 20;
  constexpr int kMaxDepth = 8;
  if (text.size() > kMaxBytes) throw std::runtime_error("its header has more than 32 MiB");
  return header_from(Json::parse(text, [](int depth, Json::parse_event_t event, const Json&) {
    const bool opens =
        event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    if (opens && depth >= kMaxDepth) throw std::runtime_error("its header is nested too deeply");
    return true;
  }));
} catch (const Json::parse_error& error) {  // whose text quotes what may be no text
  throw std::runtime_error(fmt::format("its header is no JSON from its byte {} on", error.byte));
} catch (const Json::exception& error) {
  throw std::runtime_error(std::string("its header cannot be read: ") + error.what());
}

}  // namespace twinarm
