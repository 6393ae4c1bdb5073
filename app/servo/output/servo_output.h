// What is told of a live run: punctuality, tracking, forces. As a table, as JSON, as a picture.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/servo/servo_loop.h"
#include "coupling/device/device_motion.h"
#include "solver/model/model.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// Gathered from the ticks by the thread that drains the ring.
struct LiveSummary {
  std::string scene, device, mapping, felt;  // in words
  std::vector<std::string> joints;
  double step = 0, duration = 0;           // [s]; the time that the run has reached
  long ticks = 0, held = 0, released = 0;  // ticks of each mode of silence
  long silences = 0;
  std::array<double, 3> max_torque{};        // felt [N m]
  std::vector<double> max_error, sum_error;  // |q_K - q_D| by joint [rad]
  std::string log, recording, picture;       // files; empty where there is none
  bool same_bits = false;                    // the run made again ended in the same state
  ServoResult servo;
  bool real_time = true;
};

std::string live_table(const LiveSummary& summary);
std::string live_json(const LiveSummary& summary);
// Two histograms, lateness and processor time of a tick; beside an empty loop's where there is one.
// SVG or PNG by the name. Throws InputError without gnuplot.
void draw_timing(const LiveSummary& summary, const std::filesystem::path& file);

// The log of a live run as a file that grows while the run goes on: what was written stays,
// whatever happens to the program (coupling/device/device_motion.h).
class LiveLog {
 public:
  // Throws InputError where it cannot be written.
  explicit LiveLog(const std::filesystem::path& file)
      : file_(file.string()), stream_(file, std::ios::binary) {
    if (!stream_)
      throw InputError({{file_, 0, "--out", "the log cannot be written", "give a folder that can",
                         "file.open"}});
    stream_ << hand_log_header();
  }
  void write(const HandStep& step) { stream_ << hand_log_line(step); }
  void flush() { stream_.flush(); }
  bool is_whole() const { return stream_.good(); }  // all that was to be written is
  // Throws InputError where not all of it could be written.
  void finish() {
    stream_.flush();
    if (!stream_)
      throw InputError({{file_, 0, "--out", "the log could not be written to its end",
                         "make room on the disk", "file.write"}});
  }

 private:
  std::string file_;
  std::ofstream stream_;
};

// A live run made again from its log, by the ordinary run of `simulate`: recorded, with ledger and
// all that a servo loop has no time for. It takes the same steps with the same bits.

// The scene with the log in place of the device, as a file of its own.
void write_scene_of_log(const std::filesystem::path& scene, const std::filesystem::path& log,
                        double step, double duration, const std::filesystem::path& file);

// Runs that scene and records it; the state at its end. Throws InputError, Interrupted.
State<double> record_again(const std::filesystem::path& scene,
                           const std::filesystem::path& recording);

}  // namespace twinarm
