// arm1_casting: horizontal arm from joint 1 to joint 2
// Link: arm1.  Material: painted_casting.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() soft_capsule(0, arm1_r1, L1, arm1_r2, arm1_bot, arm1_top, 9, 14, n = 22);
