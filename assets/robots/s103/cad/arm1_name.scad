// arm1_name: lettering on both flanks of the arm
// Link: arm1.  Material: dark_plastic.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() for (s = [-1, 1]) on_flank(0, arm1_r1, L1, arm1_r2, L1 / 2 + 5, 533, s)
    translate([0, 0, -2]) linear_extrude(3.2) lettering("UNIMATE", 28, 5.5);
