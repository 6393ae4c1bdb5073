// arm1_j2_motor_bolts: bolt circle of the motor's flange
// Link: arm1.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() translate([L1, 0, 461]) rotate([180, 0, 0]) bolts(circle_of(6, 44), -0.3, 3.2, 3.5);
