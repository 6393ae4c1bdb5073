// Registration of a shape: its file declares  Wedge numbered(ShapeNumber<8>);  without a
// definition. The numbers from 0 to the first free one are the shapes of shape.h, in this order.
#pragma once

namespace twinarm {

template <int number>
struct ShapeNumber {};

}  // namespace twinarm
