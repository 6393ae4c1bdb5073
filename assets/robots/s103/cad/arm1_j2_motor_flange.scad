// arm1_j2_motor_flange: flange of that motor
// Link: arm1.  Material: machined_aluminium.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() translate([L1, 0, 0]) turned([[48, 460.5], [49, 461.5], [49, arm1_bot + 2]], n = 36);
