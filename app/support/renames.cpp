#include "app/support/text.h"

#include <nlohmann/json.hpp>

#include "solver/support/embedded_file.h"

namespace twinarm {

const std::vector<EmbeddedFile>& rename_files();  // of twinarm_embed()

std::string renamed(const std::string& kind, const std::string& old) {
  static const auto all = nlohmann::ordered_json::parse(rename_files().at(0).text);
  return all.at(kind).value(old, "");
}

}  // namespace twinarm
