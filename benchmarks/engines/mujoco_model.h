// Helpers for MuJoCo models: numbers as MJCF, and loading from memory.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace twinarm::bench {

// With all digits, each followed by a space.
template <class Numbers>
std::string mjcf(const Numbers& numbers) {
  std::ostringstream out;
  out.precision(17);
  for (const double number : numbers) out << number << ' ';
  return out.str();
}

struct MujocoRun {
  struct Release {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };
  std::unique_ptr<mjModel, Release> model;
  std::unique_ptr<mjData, Release> data;

  MujocoRun() = default;
  // From files in memory, names and texts; the model is last.
  explicit MujocoRun(const std::vector<std::pair<std::string, std::string>>& files) {
    // avoids a log file
    mju_user_warning = [](const char* what) { std::cerr << "MuJoCo warns: " << what << '\n'; };
    const auto disk = std::make_unique<mjVFS>();
    mj_defaultVFS(disk.get());
    for (const auto& [name, xml] : files) {
      mj_makeEmptyFileVFS(disk.get(), name.c_str(), static_cast<int>(xml.size()));
      std::copy(xml.begin(), xml.end(), static_cast<char*>(disk->filedata[disk->nfile - 1]));
    }
    char fault[500] = "";
    model.reset(mj_loadXML(files.back().first.c_str(), disk.get(), fault, sizeof fault));
    mj_deleteVFS(disk.get());
    if (!model) throw std::runtime_error(std::string("MuJoCo: ") + fault);
    data.reset(mj_makeData(model.get()));
  }
};

}  // namespace twinarm::bench
