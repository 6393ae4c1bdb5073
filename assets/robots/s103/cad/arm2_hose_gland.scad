// arm2_hose_gland: gland of that hose on the tower
// Link: arm2.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() translate([0, 0, 838]) rotate([0, 90, 0]) soft_cylinder(11.5, tower_x[0] - 10, tower_x[0] + 10, 1.5, 0, n = 24, k = 2);
