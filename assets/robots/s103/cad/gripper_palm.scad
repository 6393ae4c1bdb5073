// gripper_palm: palm: body with the fingers' cylinder
// Link: gripper.  Material: graphite_casting.
include <dimensions.scad>
use <lib_shapes.scad>

in_gripper() soft_box(-24, 24, 50, 9, palm_bot, flange_bot + 1, 2.5, 4, n = 4, k = 3);
