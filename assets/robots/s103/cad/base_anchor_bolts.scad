// base_anchor_bolts: four anchor bolts of the foot plate
// Link: base.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() lofts([for (x = [plate_x[0] + 20, plate_x[1] - 18], y = [-1, 1] * (plate_y - 19))
    bolt_socket([x, y], plate_h + 4.8, 7.5, 8, n = 10)]);
