// arm2_cover: cover of arm 2
// Link: arm2.  Material: white_plastic.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() soft_capsule(0, arm2_r1 - 0.5, L2, arm2_r2 - 0.5, arm2_seam + 4, arm2_top, 0, 18, n = 24, k = 5);
