// The arrays of a page as one block: deflated, in base64, and told in its JSON by where they lie.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/data/json_writer.h"
#include "app/draw/snapshot.h"
#include "app/film/filmed_run.h"
#include "app/record/recording.h"
#include "app/record/recording_reader.h"
#include "app/run/run.h"
#include "app/run/simulate_input.h"

namespace twinarm {

// What the plots of pages show of a frame: its quantities, by name. The same for the page of a
// recorded run and for a run that goes on (app/lab/stream).
class RunChannels {
 public:
  // The columns of a run, in their order, then couplings.
  // Of both arguments parts are copied.
  RunChannels(const SimulateInput& input, const RecordingHeader& header);
  // Two geometries that touch. True: it was not there yet.
  bool add_pair(int a, int b);
  // Joints that a hand turns: where it has them, and the recorded value less that.
  void add_led_joints(const Coordinates& coordinates, const std::vector<SceneCoupling>& couplings);
  // One of the caller's own, which fills it in; its place.
  std::size_t add(const std::string& name, const std::string& unit, const std::string& kind,
                  const std::string& of);

  const std::vector<RunColumn>& all() const { return all_; }
  // By channel; NaN for those that are not known in this frame. `couplings`: those of the moment;
  // null for a robot alone.
  void values(const RecordedFrame& frame, const Snapshot& moment, SceneCouplings* couplings,
              std::vector<double>& values) const;

 private:
  struct Led {
    std::size_t coupling, column, target, error;  // of all_: where they stand
    NamedJoint joint;
  };
  std::size_t place_of(const std::string& name) const;

  std::vector<RunColumn> all_;
  std::vector<std::string> geometries_;
  std::size_t columns_ = 0, pulls_ = 0, elastic_ = 0, first_pull_ = 0;
  std::map<std::pair<int, int>, std::size_t> pairs_;  // places by geometries
  std::vector<Led> led_;
};

// Its members, of the object that is open.
void write_channel(JsonWriter& json, const RunColumn& channel);

class PageBytes {
 public:
  // Writes {"at": byte, "count": n, "type": "f64"} as the value of the key.
  template <class T>
  void add(JsonWriter& json, const char* key, const std::vector<T>& values) {
    json.key(key);
    write_place(json, values.data(), values.size(), sizeof(T), type_name(T{}));
  }
  std::size_t size() const { return bytes_.size(); }
  std::string packed() const;  // zlib's format, then base64

 private:
  static const char* type_name(std::uint8_t) { return "u8"; }
  static const char* type_name(std::int8_t) { return "i8"; }
  static const char* type_name(std::uint16_t) { return "u16"; }
  static const char* type_name(std::int16_t) { return "i16"; }
  static const char* type_name(std::uint32_t) { return "u32"; }
  static const char* type_name(float) { return "f32"; }
  static const char* type_name(double) { return "f64"; }
  void write_place(JsonWriter& json, const void* data, std::size_t count, std::size_t size,
                   const char* type);

  std::string bytes_;
};

// What the plots of a page show: quantities over its frames, and both ledgers' numbers.
class PageChannels {
 public:
  explicit PageChannels(const FilmedRun& run);
  // The recorded frame, and the moment of the same time.
  void add_frame(const RecordedFrame& frame, const Snapshot& moment);
  // Keys times, channels, ledger, momentum, bodies.
  void write(JsonWriter& json, PageBytes& bytes) const;

 private:
  const FilmedRun& run_;
  RunChannels channels_;
  std::vector<std::vector<double>> values_;  // by channel, by frame
  std::vector<double> now_;                  // by channel
  std::vector<double> times_, works_;        // works by frame, then by row
  std::vector<double> end_;                  // of the last frame, by row [J]
  // Of the ledger of momentum by frame, by row: linear, then angular [N s], [N m s].
  std::vector<double> momenta_;
};

}  // namespace twinarm
