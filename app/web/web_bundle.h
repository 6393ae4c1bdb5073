// Templates of the pages: TypeScript of src/, bundled when the program is built (bundle.cmake).
#pragma once

#include <string_view>

namespace twinarm {

struct WebBundle {
  // With marks, which app/page/pages.h fills in; empty: not built.
  std::string_view replay, inspect;
  std::string_view lab;      // complete
  std::string_view missing;  // why there are none, and what to do
};
WebBundle web_bundle();

}  // namespace twinarm
