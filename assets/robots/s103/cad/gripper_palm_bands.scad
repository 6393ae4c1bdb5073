// gripper_palm_bands: end caps of the palm
// Link: gripper.  Material: orange_enamel.
include <dimensions.scad>
use <lib_shapes.scad>

in_gripper() for (s = [0, 1]) mirror([0, s, 0]) translate([0, 48, (palm_bot + flange_bot) / 2]) rotate([-90, 0, 0])
    soft_box(-15, 15, 10, 5, -2, 5, 0, 1.5, n = 3, k = 1);
