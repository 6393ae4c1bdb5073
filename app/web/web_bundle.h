// The pages' templates: TypeScript of src/, bundled when the program was built (bundle.cmake).
#pragma once

#include <string_view>

namespace twinarm {

struct WebBundle {
  // With marks to be filled in (app/page/pages.h); empty: none was built.
  std::string_view replay, inspect;
  std::string_view lab;      // whole, as it is
  std::string_view missing;  // why there is none, and what to do
};
WebBundle web_bundle();

}  // namespace twinarm
