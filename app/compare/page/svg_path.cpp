#include "app/compare/page/svg_path.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace twinarm::compare_page {
namespace {

constexpr double kOffLine = 1.25;  // tenths of a pixel

struct Point {
  long x, y;  // tenths of a pixel
};
using Polyline = std::vector<Point>;

// Douglas and Peucker: of the points between two that stay, the farthest stays if it is far.
void keep_far_points(const Polyline& all, std::size_t first, std::size_t last,
                     std::vector<bool>& stays) {
  const double dx = double(all[last].x - all[first].x), dy = double(all[last].y - all[first].y);
  const double length = std::hypot(dx, dy);
  double farthest = kOffLine;
  std::size_t at = first;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double x = double(all[i].x - all[first].x), y = double(all[i].y - all[first].y);
    // Beyond the ends of the line its distance is not that of the line.
    const double along = length > 0 ? (x * dx + y * dy) / length : 0;
    const double off = along < 0 || length == 0 ? std::hypot(x, y)
                       : along > length         ? std::hypot(x - dx, y - dy)
                                                : std::abs(x * dy - y * dx) / length;
    if (off > farthest) farthest = off, at = i;
  }
  if (at == first) return;
  stays[at] = true;
  keep_far_points(all, first, at, stays);
  keep_far_points(all, at, last, stays);
}

Polyline thinned(const Polyline& all) {
  if (all.size() < 3) return all;
  std::vector<bool> stays(all.size(), false);
  stays.front() = stays.back() = true;
  keep_far_points(all, 0, all.size() - 1, stays);
  Polyline few;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (stays[i]) few.push_back(all[i]);
  return few;
}

// 12 is 1.2, -3 is -.3.
std::string tenths(long n) {
  std::string text = n < 0 ? "-" : "";
  n = std::abs(n);
  if (n >= 10 || n == 0) text += std::to_string(n / 10);
  if (n % 10 != 0) text += "." + std::to_string(n % 10);
  return text;
}

void append_number(std::string& text, long n, char between) {
  if (n >= 0) text += between;  // a sign parts as well
  text += tenths(n);
}

std::string written(const Polyline& line) {
  std::string text = "M" + tenths(line[0].x);
  append_number(text, line[0].y, ',');
  for (std::size_t i = 1; i < line.size(); ++i) {
    const long dx = line[i].x - line[i - 1].x, dy = line[i].y - line[i - 1].y;
    if (i == 1)
      text += "l" + tenths(dx);
    else
      append_number(text, dx, ' ');
    append_number(text, dy, ',');
  }
  return text;
}

}  // namespace

std::string short_path(std::string_view d) {
  std::vector<Polyline> lines;
  std::vector<long> numbers;
  const std::string text(d);
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == 'M') {
      if (numbers.size() % 2 != 0) return text;
      numbers.clear();
      lines.emplace_back();
    }
    if (c == 'M' || c == 'L' || c == ',' || std::isspace(static_cast<unsigned char>(c)) != 0) {
      ++i;
      continue;
    }
    char* end = nullptr;
    const double value = std::strtod(text.c_str() + i, &end);
    if (end == text.c_str() + i || lines.empty()) return text;
    i = static_cast<std::size_t>(end - text.c_str());
    numbers.push_back(std::lround(10 * value));
    if (numbers.size() % 2 == 0)
      lines.back().push_back({numbers[numbers.size() - 2], numbers.back()});
  }
  std::string result;
  for (const Polyline& line : lines)
    if (line.size() > 1) result += written(thinned(line));
  return result;
}

}  // namespace twinarm::compare_page
