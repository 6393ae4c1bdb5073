// Settings of a run for its page: command, versions, options, couplings, bodies, files.
#pragma once

#include <string>
#include <vector>

#include "app/data/json_writer.h"
#include "app/draw/scene_view.h"
#include "app/film/filmed_run.h"

namespace twinarm {

// Quoted for a shell; the program without its path.
std::string command_line(const std::vector<std::string>& words);

// Keys title, command, facts, tables, files, notes. `rate`: frames of the page per second.
void write_facts(JsonWriter& json, const FilmedRun& run, const SceneView& view, double rate);

}  // namespace twinarm
