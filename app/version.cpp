#include "app/version.h"

namespace twinarm {

const char* const kVersion = TWINARM_VERSION;

}  // namespace twinarm
