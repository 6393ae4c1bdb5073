// arm1_gusset: rib below the arm
// Link: arm1.  Material: painted_casting.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() rotate([90, 0, 0]) linear_extrude(30, center = true)
    polygon(concat([for (a = [0 : 9 : 90]) [200 - 142 * cos(a), 340 + 136 * sin(a)]],
                   [[40, 476], [40, 340]]));
