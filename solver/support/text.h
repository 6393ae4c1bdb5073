// Small operations on texts.
#pragma once

#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace twinarm {

// Of ASCII letters.
inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

// "a,b" split at each separator; an empty text gives one empty field.
inline std::vector<std::string> split(const std::string& text, char separator = ',') {
  std::vector<std::string> fields(1);
  for (const char c : text)
    if (c == separator)
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

// With `to` in each place of `from`.
inline std::string replace_all(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

// For XML and HTML.
inline std::string escaped(std::string_view text) {
  std::string all;
  for (const char c : text)
    all += c == '&'   ? "&amp;"
           : c == '<' ? "&lt;"
           : c == '>' ? "&gt;"
           : c == '"' ? "&quot;"
                      : std::string(1, c);
  return all;
}

}  // namespace twinarm
