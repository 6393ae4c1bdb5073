// Output of a live run: timing, tracking errors, forces; as table, JSON and picture; its log.
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

// Collected from the ticks by the thread that drains the ring.
struct LiveSummary {
  std::string scene, device, mapping, force_feedback;  // descriptions
  std::vector<std::string> joints;
  double step = 0, duration = 0;           // [s]; run time
  long ticks = 0, held = 0, released = 0;  // ticks in each mode of the watchdog
  long silences = 0;
  std::array<double, 3> max_torque{};        // [N m]
  std::vector<double> max_error, sum_error;  // |q_K - q_D| by joint [rad]
  std::string log, recording, picture;       // files; empty: none
  bool same_bits = false;                    // the re-simulated run ended in the same state
  ServoResult servo;
  bool real_time = true;

  double mean_error(std::size_t joint) const {
    return sum_error[joint] / static_cast<double>(std::max(1L, ticks));
  }
};

std::string live_table(const LiveSummary& summary);
std::string live_json(const LiveSummary& summary);
// Histograms of wake-up latency and processor time per tick, with those of the empty loop if any.
// An SVG. Throws InputError: no gnuplot.
void draw_timing(const LiveSummary& summary, const std::filesystem::path& file);

// Log of a live run (coupling/device/device_motion.h), written while it runs.
class LiveLog {
 public:
  // Throws InputError: not writable.
  explicit LiveLog(const std::filesystem::path& file) : file_(file.string()) {
    std::error_code ignored;
    if (std::filesystem::is_symlink(file, ignored))
      std::filesystem::remove(file, ignored);  // not followed
    stream_.open(file, std::ios::binary);
    if (!stream_)
      throw InputError(
          {{file_, 0, "--out", "cannot write the log", "give a writable folder", "file.open"}});
    stream_ << device_log_header();
  }
  void write(const DeviceStep& step) { stream_ << device_log_line(step); }
  void flush() { stream_.flush(); }
  bool is_whole() const { return stream_.good(); }  // everything was written
  // Throws InputError: not everything was written.
  void finish() {
    stream_.flush();
    if (!stream_)
      throw InputError({{file_, 0, "--out", "cannot write the end of the log",
                         "free space on the disk", "file.write"}});
  }

 private:
  std::string file_;
  std::ofstream stream_;
};

// Re-simulation of a live run from its log, as by `simulate`, bit for bit, with energy balance and
// recording. This writes the scene with the log in place of the device.
void write_scene_of_log(const std::filesystem::path& scene, const std::filesystem::path& log,
                        double step, double duration, const std::filesystem::path& file);

// Runs that scene and records it; returns the last state. Throws InputError, Interrupted.
State<double> record_again(const std::filesystem::path& scene,
                           const std::filesystem::path& recording);

}  // namespace twinarm
