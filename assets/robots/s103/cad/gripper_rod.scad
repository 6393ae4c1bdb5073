// gripper_rod: lifting rod, sliding in the quill
// Link: gripper.  Material: polished_steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_gripper() soft_cylinder(rod_r, flange_bot + 2, collar_bot + lift + 40, 0, 1.5, n = 24, k = 1);
