// Which engines this build has; CMake says which libraries were found.
#include <ctime>

#include "benchmarks/speed/contact_engine.h"

namespace twinarm::speed {

ContactEngines all_contact_engines() {
  ContactEngines engines;
  add_twinarm(engines);
#ifdef TWINARM_WITH_MUJOCO
  add_mujoco(engines);
#endif
#ifdef TWINARM_WITH_BULLET
  add_bullet(engines);
#endif
  return engines;
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace twinarm::speed
