// arm2_j2_cap_bolts: bolt circle on that cover
// Link: arm2.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() bolts(circle_of(6, 29, a0 = 30), cap2_top - 1.2, 3.2, 4);
