// Paths of a figure in few characters.
#pragma once

#include <string>
#include <string_view>

namespace twinarm::compare_page {

// Of the `d` of a path made of moves and lines: without points that lie on the line between others
// to an eighth of a pixel, from point to point, in tenths of a pixel. Any other path as it is.
std::string short_path(std::string_view d);

}  // namespace twinarm::compare_page
