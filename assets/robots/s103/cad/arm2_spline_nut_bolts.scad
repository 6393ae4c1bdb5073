// arm2_spline_nut_bolts: bolt circle of the spline nut
// Link: arm2.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() translate([L2, 0, nut_bot + 9.6]) rotate([180, 0, 0]) bolts(circle_of(6, 36), -0.3, 3.2, 3.5);
