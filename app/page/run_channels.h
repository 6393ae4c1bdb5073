// What the plots of pages show of a frame: its quantities, by name. The same for the page of a
// recorded run (page_channels.h) and for a run that goes on (app/lab/stream).
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/data/json_writer.h"
#include "app/draw/snapshot.h"
#include "app/record/recording.h"
#include "app/run/run_columns.h"
#include "app/run/simulate_input.h"

namespace twinarm {

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
  void values(const RecordedFrame& frame, const Moment& moment, SceneCouplings* couplings,
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

}  // namespace twinarm
