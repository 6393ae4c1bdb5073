// What the plots of a page show: quantities over its frames, and both ledgers' numbers.
#pragma once

#include <string>
#include <vector>

#include "app/record/recording_reader.h"
#include "app/show/command/filmed_run.h"
#include "app/web/page_bytes.h"

namespace twinarm {

struct PageChannel {
  std::string name, unit, kind, of;  // as in src/data/run.ts
  std::vector<double> values;        // one a frame
};

class PageChannels {
 public:
  explicit PageChannels(const FilmedRun& run);
  // The recorded frame, and the moment of the same time.
  void add_frame(const RecordedFrame& frame, const Moment& moment);
  // Keys times, channels, ledger, momentum, bodies.
  void write(JsonWriter& json, PageBytes& bytes) const;

 private:
  // A joint's number that a hand moves too: the recorded value less that of the kinematic robot.
  struct Led {
    std::size_t coupling, column, target, error;  // of channels_: where they stand
    const NamedJoint* joint;
    std::size_t component;
  };
  std::size_t add_channel(const std::string& name, const std::string& unit, const std::string& kind,
                          const std::string& of);
  void find_led_joints();
  void find_pairs();
  void add_led(double t);
  void add_contacts(const RecordedFrame& frame);
  void add_ledgers(const RecordedFrame& frame);
  std::string name_of_geometry(int id) const;

  const FilmedRun& run_;
  const RecordingHeader& header_;
  std::vector<PageChannel> channels_;
  std::vector<Led> led_;
  std::vector<std::pair<int, int>> pairs_;  // geometries
  std::size_t first_pull_ = 0, first_pair_ = 0, elastic_ = 0;
  std::vector<double> times_, works_;  // works by frame, then by row
  std::vector<double> end_;            // of the last frame, by row [J]
  // Of the ledger of momentum by frame, by row: linear, then angular [N s], [N m s].
  std::vector<double> momenta_;
};

}  // namespace twinarm
