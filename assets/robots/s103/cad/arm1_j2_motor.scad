// arm1_j2_motor: motor of joint 2 with cooling fins, hanging below the arm
// Link: arm1.  Material: graphite_casting.
include <dimensions.scad>
use <lib_shapes.scad>

fins = [for (i = [0 : 4]) let (z = 399 + i * 12.5) each [[35, z], [41, z + 1], [41, z + 6], [35, z + 7]]];
in_arm1() translate([L1, 0, 0]) turned(concat([[33, 384], [38, 386], [40, 390], [40, 395]], fins, [[35, 464], [35, arm1_bot + 3]]), n = 24);
