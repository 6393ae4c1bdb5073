// What a run was made of, in words: command, versions, settings, couplings, bodies, files.
#pragma once

#include <string>
#include <vector>

#include "app/data/json_writer.h"
#include "app/draw/scene_view.h"
#include "app/film/filmed_run.h"

namespace twinarm {

// As a shell reads it back; the program by its name alone.
std::string command_line(const std::vector<std::string>& words);

// Keys title, command, facts, tables, files, notes. `rate`: frames of the page per second.
void write_facts(JsonWriter& json, const FilmedRun& run, const SceneView& stage, double rate);

}  // namespace twinarm
