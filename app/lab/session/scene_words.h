// Title, file and hints of a scene, for the lab's page.
#pragma once

#include <string>
#include <vector>

namespace twinarm {

// What the scene's message says besides.
struct SceneWords {
  std::string title, file;        // title empty: the file's name in words
  std::vector<std::string> look;  // what to look for
};

}  // namespace twinarm
