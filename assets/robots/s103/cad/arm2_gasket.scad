// arm2_gasket: seam between the casting and the cover of arm 2
// Link: arm2.  Material: rubber.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() soft_capsule(0, arm2_r1 - 2, L2, arm2_r2 - 2, arm2_seam - 1, arm2_seam + 5, 0, 0, n = 20);
