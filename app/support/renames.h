// Names that replaced others in options, scene files and JSON output (assets/renamed.json).
#pragma once

#include <string>

namespace twinarm {

// The name that replaced `old`; empty if none did. `kind`: "commands", "options" (with "--"),
// "keys" and "values" of scene files, "choices" of options.
std::string renamed(const std::string& kind, const std::string& old);

}  // namespace twinarm
