// How the help, the manual and the site tell what an option takes: "--port N", and "(0 to 65535)"
// at the end of its words.
#pragma once

#include <memory>
#include <string>

namespace CLI {
class FormatterBase;
class Option;
}  // namespace CLI

namespace twinarm {

std::string value_word(const CLI::Option& option);    // NUMBER, N, TEXT, PATH ..; empty: a flag
std::string value_limits(const CLI::Option& option);  // "above 0"; empty: none that are told
std::shared_ptr<CLI::FormatterBase> help_formatter();

}  // namespace twinarm
