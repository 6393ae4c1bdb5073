// base_bosses: bosses of the anchor bolts on the foot plate
// Link: base.  Material: graphite_casting.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() lofts([for (x = [plate_x[0] + 20, plate_x[1] - 18], y = [-1, 1] * (plate_y - 19))
    rings_cylinder(14, plate_h - 2, plate_h + 3, 0, 1.5, n = 20, k = 1, c = [x, y])]);
