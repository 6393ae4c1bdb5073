// gripper_rail: guide rail of the fingers
// Link: gripper.  Material: polished_steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_gripper() soft_box(-9, 9, 47, 2, palm_bot - 7, palm_bot + 3, 1, 0, n = 3, k = 1);
