// base_plate: foot plate
// Link: base.  Material: graphite_casting.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() soft_box(plate_x[0], plate_x[1], plate_y, 24, 0, plate_h, 0, 5, k = 3);
