// arm1_box_lid: lid of the junction box
// Link: arm1.  Material: graphite_casting.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() translate([box_x[0] + 1, 0, 457]) rotate([0, -90, 0]) soft_box(-80, 80, 36, 8, -3, 5, 0, 2, n = 3, k = 1);
