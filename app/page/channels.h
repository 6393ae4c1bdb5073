// Numbers of a page: channels of a run, and their arrays in one deflated block in base64.
#pragma once

#include <map>
#include <string>
#include <type_traits>
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

// Plotted quantities of a frame, by name: for pages of recorded runs and for the lab
// (app/lab/stream).
class RunChannels {
 public:
  // Columns of a run, then couplings. Does not keep the arguments.
  RunChannels(const SimulateInput& input, const RecordingHeader& header);
  // Contact of two geometries; false if it is there already, or kMaxPairs are.
  bool add_pair(int a, int b);
  // The thousands of a heap would fill the page's memory.
  static constexpr std::size_t kMaxPairs = 100;
  // Target and tracking error of joints that a device or motion moves.
  void add_led_joints(const Coordinates& coordinates, const std::vector<SceneCoupling>& couplings);
  // A channel that the caller fills in; returns its index.
  std::size_t add(const std::string& name, const std::string& unit, const std::string& kind,
                  const std::string& of);

  const std::vector<RunColumn>& all() const { return all_; }
  // By channel; NaN if unknown in this frame. `couplings`: null for a robot alone.
  void values(const RecordedFrame& frame, const Snapshot& snapshot, SceneCouplings* couplings,
              std::vector<double>& values) const;

 private:
  struct Led {
    std::size_t coupling, column, target, error;  // indices into all_, but for the coupling
    NamedJoint joint;
  };
  std::size_t place_of(const std::string& name) const;

  std::vector<RunColumn> all_;
  std::vector<std::string> geometries_;
  std::size_t columns_ = 0, pulls_ = 0, elastic_ = 0, first_pull_ = 0;
  std::map<std::pair<int, int>, std::size_t> pairs_;  // indices by geometries
  std::vector<Led> led_;
};

// Members of a JSON object.
void write_channel(JsonWriter& json, const RunColumn& channel);

class PageBytes {
 public:
  // Writes {"at": byte, "count": n, "type": "f64"} as the value of the key.
  template <class T>
  void add(JsonWriter& json, const char* key, const std::vector<T>& values) {
    const char kind = std::is_floating_point_v<T> ? 'f' : std::is_signed_v<T> ? 'i' : 'u';
    write_place(json.key(key), values.data(), values.size(), sizeof(T), kind);
  }
  std::string packed() const;  // zlib's format, then base64

 private:
  void write_place(JsonWriter& json, const void* data, std::size_t count, std::size_t size,
                   char kind);

  std::string bytes_;
};

// Channels over the frames of a page, with energy and momentum balance.
class PageChannels {
 public:
  explicit PageChannels(const FilmedRun& run);
  // A recorded frame and the snapshot of the same time.
  void add_frame(const RecordedFrame& frame, const Snapshot& snapshot);
  // Keys times, channels, energy_balance, momentum, bodies.
  void write(JsonWriter& json, PageBytes& bytes) const;

 private:
  const FilmedRun& run_;
  RunChannels channels_;
  std::vector<std::vector<double>> values_;  // by channel, by frame
  std::vector<double> now_;                  // by channel
  std::vector<double> times_, works_;        // works by frame, then by row
  std::vector<double> end_;                  // of the last frame, by row [J]
  std::vector<double> momenta_;  // by frame, then by row: linear, angular [N s], [N m s]
};

}  // namespace twinarm
