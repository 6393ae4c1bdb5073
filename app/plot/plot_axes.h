// Axes of the page's figures: few numbers, none of them crowded.
#pragma once

#include <string>
#include <vector>

namespace twinarm::compare_page {

// Lines of a gnuplot script. `axis` is "x" or "y".
// A mark at every 1, 2 or 5 times a power of ten, about so many.
std::string tics(const char* axis, double low, double high, int about);
// Around all that is finite; what is constant to all its digits has room around it.
std::string range_of(const std::vector<const std::vector<double>*>& all);
// Around the numbers; less than a decade and a half is marked at 1, 2 and 5.
std::string log_axis(const char* axis, double low, double high);

}  // namespace twinarm::compare_page
