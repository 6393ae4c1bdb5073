// File that is embedded in the program at build time (scripts/cmake/embed.cmake).
#pragma once

#include <string_view>

namespace twinarm {

struct EmbeddedFile {
  std::string_view name;  // path relative to the embedded folder
  std::string_view text;
};

}  // namespace twinarm
