// Version of the program, from CMakeLists.txt.
#pragma once

namespace twinarm {

extern const char* const kProgramVersion;

}  // namespace twinarm
