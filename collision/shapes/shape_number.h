// A shape that is stated by a few numbers has a number of its own, said in its file by a function
// that is only declared:  Wedge numbered(ShapeNumber<8>);
// Those from 0 to the first that is free are the shapes of shape.h, in this order.
#pragma once

namespace twinarm {

template <int number>
struct ShapeNumber {};

}  // namespace twinarm
