#include "app/commands.h"
#include "app/study/calibrate.h"

namespace twinarm {

int run_study(const StudyOptions& options) {
  const std::filesystem::path assets = find_assets(options.assets);
  const StudyInputs inputs = load_inputs(assets);
  Progress progress(false);
  if (options.recalibrate)
    write_calibration(calibrate(inputs, progress), assets / "study" / "calibration.json");
  return 0;
}

}  // namespace twinarm
