// gripper_flange: tool flange
// Link: gripper.  Material: machined_aluminium.
include <dimensions.scad>
use <lib_shapes.scad>

in_gripper() turned([[31, flange_bot], [32, flange_bot + 1], [32, flange_bot + 8], [31, flange_bot + 9.5], [16, flange_bot + 10], [14, flange_bot + 12], [13.5, flange_bot + 20], [12, flange_bot + 22]], n = 32);
