// gnuplot's SVG at a third of its size, to the eye the same: a page holds hundreds of figures.
#pragma once

#include <string>

namespace twinarm::compare_page {

// Places to a tenth of a pixel; without groups that are empty, marks and filters that nobody uses,
// and attributes that the style sheet gives to every figure (page_style.h, `figure svg`).
std::string small_svg(const std::string& svg);

}  // namespace twinarm::compare_page
