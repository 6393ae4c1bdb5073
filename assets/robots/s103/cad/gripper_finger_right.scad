// gripper_finger_right: finger on the -y side
// Link: gripper.  Material: machined_aluminium.
include <dimensions.scad>
use <lib_shapes.scad>

in_gripper() rotate([90, 0, 90]) linear_extrude(24, center = true) mirror([1, 0]) offset(1.5, $fn = 16) offset(-1.5)
    polygon([[13, palm_bot - 2], [40, palm_bot - 2], [40, palm_bot - 14], [33, palm_bot - 20], [26, finger_bot + 14],
             [23, finger_bot], [16, finger_bot], [16, palm_bot - 16], [13, palm_bot - 16]]);
