#include "app/trial/top_view.h"

#include <algorithm>
#include <cmath>

namespace twinarm {

TopView::TopView(double half, int columns)
    : half_(half), columns_(columns), rows_(std::max(1, columns / 2)) {
  clear();
}

void TopView::clear() {
  lines_.assign(static_cast<std::size_t>(rows_),
                std::string(static_cast<std::size_t>(columns_), ' '));
}

int TopView::column(double x) const {
  return static_cast<int>(std::floor((x + half_) / (2 * half_) * columns_));
}
int TopView::row(double y) const {
  return static_cast<int>(std::floor((half_ - y) / (2 * half_) * rows_));
}

void TopView::point(const Vector3& p, char mark) {
  if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1e3) return;
  const int c = column(p.x()), r = row(p.y());
  if (c < 0 || c >= columns_ || r < 0 || r >= rows_) return;
  lines_[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] = mark;
}

void TopView::line(const Vector3& a, const Vector3& b, char mark) {
  const int steps = 2 * columns_;  // finer than the characters
  for (int i = 0; i <= steps; ++i) point(a + (b - a) * i / steps, mark);
}

std::string TopView::text() const {
  const std::string edge = "+" + std::string(static_cast<std::size_t>(columns_), '-') + "+\n";
  std::string all = edge;
  for (const std::string& line : lines_) all += "|" + line + "|\n";
  return all + edge;
}

}  // namespace twinarm
