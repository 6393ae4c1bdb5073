// arm1_cap_bolts: bolt circle round the cover of joint 1
// Link: arm1.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() bolts(circle_of(8, 57, a0 = 22.5), arm1_top - 0.3, 3.5, 4);
