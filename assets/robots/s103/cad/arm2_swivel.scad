// arm2_swivel: hose swivel on the axis of joint 2
// Link: arm2.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() turned([[21, cap2_top - 1], [21, cap2_top + 4], [18, cap2_top + 6], [18, swivel_top - 6], [20, swivel_top - 5],
                  [20, swivel_top - 1], [19, swivel_top]], n = 28);
