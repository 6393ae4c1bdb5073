// arm2_stripe: coloured band round the casting
// Link: arm2.  Material: orange_enamel.
include <dimensions.scad>
use <lib_shapes.scad>

module outline(d) hull() { circle(arm2_r1 + d, $fn = 36); translate([L2, 0]) circle(arm2_r2 + d, $fn = 36); }
module band(z, h) translate([0, 0, z]) linear_extrude(h) difference() { outline(1.2); outline(-3); }
in_arm2() { band(604, 9); band(616.5, 3); }
