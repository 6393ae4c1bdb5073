// arm2_motor_tower: tall housing of the spindle motors
// Link: arm2.  Material: white_plastic.
include <dimensions.scad>
use <lib_shapes.scad>

shape = concat([[arm2_top - 6, 0]],
               [for (l = soft(arm2_top - 4, tower_top, 0, 16, 5)) [l[0], l[1] + 5 * (l[0] - arm2_top) / 150]]);
in_arm2() loft([for (s = shape) ring_rect(tower_x[0] + s[1], tower_x[1] - s[1], tower_y - s[1], 24 - s[1], s[0], n = 6)]);
