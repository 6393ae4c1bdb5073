// A live run made again from its log, by the ordinary run of `simulate`: recorded, with ledger and
// all that a servo loop has no time for. It takes the same steps with the same bits.
#pragma once

#include <filesystem>

#include "solver/model/model.h"

namespace twinarm {

// The scene with the log in place of the device, as a file of its own.
void write_scene_of_log(const std::filesystem::path& scene, const std::filesystem::path& log,
                        double step, double duration, const std::filesystem::path& file);

// Runs that scene and records it; the state at its end. Throws InputError, Interrupted.
State<double> record_again(const std::filesystem::path& scene,
                           const std::filesystem::path& recording);

}  // namespace twinarm
