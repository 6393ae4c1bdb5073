// quill_collar: guide of the gripper's rod at the lower end
// Link: quill.  Material: machined_aluminium.
include <dimensions.scad>
use <lib_shapes.scad>

in_quill() turned([[18, collar_bot], [21, collar_bot + 1], [22, collar_bot + 3], [22, collar_bot + 17],
                   [20.5, collar_bot + 19], [16, collar_bot + 22], [15, collar_bot + 26]], n = 32);
