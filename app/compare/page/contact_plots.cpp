#include "app/compare/page/contact_plots.h"

#include <algorithm>

namespace twinarm::compare_page {

const ContactLook* look_of(std::string_view case_name) {
  static const std::vector<ContactLook> all = [] {
    std::vector<ContactLook> looks;
    for (auto* part : {contact_look::impacts, contact_look::sliding, contact_look::rolling,
                       contact_look::buildings, contact_look::engines})
      for (const ContactLook& look : part()) looks.push_back(look);
    return looks;
  }();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const ContactLook& look) { return look.name == case_name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace twinarm::compare_page
