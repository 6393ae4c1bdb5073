// base_anchor_washers: washers of the anchor bolts
// Link: base.  Material: machined_aluminium.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() lofts([for (x = [plate_x[0] + 20, plate_x[1] - 18], y = [-1, 1] * (plate_y - 19))
    rings_cylinder(11, plate_h + 2.5, plate_h + 5, 0, 0, n = 16, c = [x, y])]);
