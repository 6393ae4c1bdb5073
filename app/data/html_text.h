// Text in pages.
#pragma once

#include <string>

namespace twinarm {

std::string escaped(const std::string& text);
// Green or red.
std::string yes_no(bool yes, const char* yes_word, const char* no_word);

}  // namespace twinarm
