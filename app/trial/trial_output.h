// Top view of the table in characters: robot, target robot, object and goal. For terminals.
#pragma once

#include <string>
#include <vector>

#include "solver/spatial/pose.h"

namespace twinarm {

class TopView {
 public:
  // `half` [m]: from the middle to each side. A character is twice as high as wide.
  explicit TopView(double half = 0.66, int columns = 66);

  // World coordinates; later marks cover earlier ones.
  void line(const Vector3& a, const Vector3& b, char mark);
  void point(const Vector3& p, char mark);
  std::string text() const;  // lines in a frame, x to the right, y up

 private:
  int column(double x) const;
  int row(double y) const;
  double half_;
  int columns_, rows_;
  std::vector<std::string> lines_;
};

}  // namespace twinarm
