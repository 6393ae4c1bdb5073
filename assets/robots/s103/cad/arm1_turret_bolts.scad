// arm1_turret_bolts: bolt circle of the moving flange
// Link: arm1.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() bolts(circle_of(12, 75), turret_bot + 15.7, 3.8, 4.5);
