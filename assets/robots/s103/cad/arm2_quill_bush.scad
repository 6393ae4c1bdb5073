// arm2_quill_bush: seal of the quill in the cover of arm 2
// Link: arm2.  Material: dark_plastic.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() translate([L2, 0, 0]) turned([[30, arm2_top - 4], [30, arm2_top + 3], [28, arm2_top + 6], [22, arm2_top + 7],
    [21, arm2_top + 14], [19.5, arm2_top + 16], [8, arm2_top + 16]], n = 28);
