// arm1_cap: cover over joint 1
// Link: arm1.  Material: orange_enamel.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() turned([[50, arm1_top - 2], [50, arm1_top + 7], [48.8, arm1_top + 10.5], [46, arm1_top + 13],
                  [41, arm1_top + 14.5], [26, arm1_top + 15.5], [2, arm1_top + 16]], n = 36);
