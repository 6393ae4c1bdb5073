// arm2_j2_cap: cover over joint 2
// Link: arm2.  Material: orange_enamel.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() turned([[45, arm2_top - 3], [45, cap2_top - 14], [44, cap2_top - 9], [41, cap2_top - 4.5],
                  [36, cap2_top - 1.5], [29, cap2_top], [2, cap2_top]], n = 36);
