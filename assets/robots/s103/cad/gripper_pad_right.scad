// gripper_pad_right: pad of the finger on the -y side
// Link: gripper.  Material: rubber.
include <dimensions.scad>
use <lib_shapes.scad>

in_gripper() mirror([0, 1, 0]) translate([0, 17, finger_bot + 13]) rotate([90, 0, 0])
    soft_box(-10, 10, 11, 2.5, 0, 5, 0, 1.2, n = 3, k = 1);
