// What the programs that write a MuJoCo model share: numbers as MJCF, and who deletes.
#pragma once

#include <mujoco/mujoco.h>

#include <sstream>
#include <string>

namespace twinarm::speed {

struct MujocoRelease {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};

// With all digits, a space after each.
template <class Numbers>
std::string mjcf(const Numbers& numbers) {
  std::ostringstream out;
  out.precision(17);
  for (const double number : numbers) out << number << ' ';
  return out.str();
}

}  // namespace twinarm::speed
