// The version of the program, as CMakeLists.txt has it.
#pragma once

namespace twinarm {

extern const char* const kProgramVersion;

}  // namespace twinarm
