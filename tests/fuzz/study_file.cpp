// Files of the study: its settings (TOML), calibration and identification (JSON).
#include "app/study/calibration/calibration.h"
#include "app/study/settings.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {

void study_file(Bytes bytes) {
  if (bytes.starts_with("{") || bytes.starts_with("[")) {
    const std::filesystem::path file = folder().write("study.json", bytes);
    goes_through([&] { read_calibration(file); });
    goes_through([&] { read_identifications(file); });
  }
  folder().write("study/settings.toml", bytes);
  goes_through([&] { read_settings(folder().path()); });
}

}  // namespace twinarm::fuzz
