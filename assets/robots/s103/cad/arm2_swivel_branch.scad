// arm2_swivel_branch: branch of the swivel to the motor tower
// Link: arm2.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() translate([0, 0, 783]) rotate([0, 90, 0]) soft_cylinder(11, 10, 32, 0, 1.5, n = 20, k = 2);
