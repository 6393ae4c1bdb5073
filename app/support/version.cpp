#include "app/support/version.h"

namespace twinarm {

const char* const kProgramVersion = TWINARM_VERSION;

}  // namespace twinarm
