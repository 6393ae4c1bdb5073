// gripper_bolts: bolt circle of the tool flange
// Link: gripper.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_gripper() bolts(circle_of(6, 24.5, a0 = 30), flange_bot + 9.2, 3.4, 4);
