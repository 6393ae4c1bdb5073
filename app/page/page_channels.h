// What the plots of a page show: quantities over its frames, and both ledgers' numbers.
#pragma once

#include <vector>

#include "app/film/filmed_run.h"
#include "app/page/page_bytes.h"
#include "app/page/run_channels.h"
#include "app/record/recording_reader.h"

namespace twinarm {

class PageChannels {
 public:
  explicit PageChannels(const FilmedRun& run);
  // The recorded frame, and the moment of the same time.
  void add_frame(const RecordedFrame& frame, const Moment& moment);
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
