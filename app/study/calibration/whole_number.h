// Whole numbers from JSON. Only .cpp files that see nlohmann-json include it.
#pragma once

#include <limits>
#include <nlohmann/json.hpp>

namespace twinarm {

// Throws the library's own exception where the value is no whole number that fits.
template <class Number>
Number whole(const nlohmann::json& value) {
  const double number = value.get<double>();
  if (!value.is_number_integer() ||
      number < static_cast<double>(std::numeric_limits<Number>::min()) ||
      number >= static_cast<double>(std::numeric_limits<Number>::max()))
    throw nlohmann::json::other_error::create(501, "a whole number is wanted", &value);
  return value.get<Number>();
}

}  // namespace twinarm
