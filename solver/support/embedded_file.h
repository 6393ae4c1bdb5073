// A file as it was when the program was built (scripts/cmake/embed.cmake).
#pragma once

#include <string_view>
#include <vector>

namespace twinarm {

struct EmbeddedFile {
  std::string_view name;  // its path below the folder that was embedded
  std::string_view text;
};

}  // namespace twinarm
