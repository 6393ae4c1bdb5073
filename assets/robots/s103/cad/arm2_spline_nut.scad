// arm2_spline_nut: flanged spline nut below arm 2
// Link: arm2.  Material: machined_aluminium.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() translate([L2, 0, 0])
    turned([[28, nut_bot], [30, nut_bot + 1.5], [30, nut_bot + 9], [41, nut_bot + 9.5], [42, nut_bot + 11], [42, arm2_bot + 2]], n = 36);
