// Which engines this build has; CMake says which libraries were found.
#include "benchmarks/peers/peer.h"

namespace twinarm::peers {

Peers all_peers() {
  Peers peers;
  add_twinarm(peers);
#ifdef TWINARM_WITH_MUJOCO
  add_mujoco(peers);
#endif
#ifdef TWINARM_WITH_BULLET
  add_bullet(peers);
#endif
#ifdef TWINARM_WITH_DART
  add_dart(peers);
#endif
#ifdef TWINARM_WITH_SIMBODY
  add_simbody(peers);
#endif
#ifdef TWINARM_WITH_ODE
  add_ode(peers);
#endif
  return peers;
}

std::vector<std::string> missing_peers() {
  std::vector<std::string> missing{"mujoco", "bullet", "dart", "simbody", "ode"};
  for (const auto& peer : all_peers())
    for (std::size_t i = missing.size(); i-- > 0;)
      if (missing[i] == peer->name()) missing.erase(missing.begin() + static_cast<long>(i));
  return missing;
}

}  // namespace twinarm::peers
