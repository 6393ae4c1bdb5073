// arm2_casting: lower half of arm 2, from joint 2 to joint 3
// Link: arm2.  Material: painted_casting.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() soft_capsule(0, arm2_r1, L2, arm2_r2, arm2_bot, arm2_seam, 10, 1.5, n = 22);
