// arm1_stripes: two coloured bands round the arm
// Link: arm1.  Material: orange_enamel.
include <dimensions.scad>
use <lib_shapes.scad>

module outline(d) hull() { circle(arm1_r1 + d, $fn = 36); translate([L1, 0]) circle(arm1_r2 + d, $fn = 36); }
module band(z, h) translate([0, 0, z]) linear_extrude(h) difference() { outline(1.2); outline(-3); }
in_arm1() { band(484, 14); band(502, 4); }
