// arm2_name: lettering on both flanks of arm 2
// Link: arm2.  Material: dark_plastic.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() for (s = [-1, 1]) on_flank(0, arm2_r1, L2, arm2_r2, 150, 643, s)
    translate([0, 0, -2]) linear_extrude(3.2) lettering("S-103", 30, 6);
