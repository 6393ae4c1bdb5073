// What a hand did in a live run, step by step, as a CSV file: from it the run can be made again
// with the same bits, recorded and inspected. Columns
//   t[s], h[s], theta1[rad] .. theta6[rad], theta1_dot[rad/s] .. theta6_dot[rad/s], button
// with 17 digits. Unlike a trace (coupling/target/recorded_trace.h) nothing is interpolated: each
// line is what the kinematic robot was told for one step.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "coupling/device/device_motion.h"

namespace twinarm {

std::string hand_log_header();
std::string hand_log_line(const HandStep& step);

// All steps that the hand remembers, to a temporary name, then renamed.
void write_hand_log(const LiveHand& hand, const std::filesystem::path& file);

// Whether the file's header is that of a log, and not of a trace. False where it cannot be read.
bool is_hand_log(const std::filesystem::path& file);
// Throws one InputError with every fault of the file. A torn last line, of a run that was killed,
// is left out.
std::unique_ptr<LiveHand> read_hand_log(const std::filesystem::path& file);

// The hand of a file, log or trace. Throws InputError with all of its faults.
std::unique_ptr<HandSource> read_hand_file(const std::filesystem::path& file);

}  // namespace twinarm
