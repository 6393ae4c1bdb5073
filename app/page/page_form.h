// A page from its template: title, JSON and bytes in their places.
#pragma once

#include <string>
#include <string_view>

#include "app/data/json_writer.h"
#include "app/page/page_bytes.h"

namespace twinarm {

// Throws InputError where there is no template; `instead` says what else there is.
void require_form(std::string_view form, std::string_view missing, const std::string& instead);
std::string fill_form(std::string_view form, const std::string& title, const JsonWriter& json,
                      const PageBytes& bytes);

}  // namespace twinarm
