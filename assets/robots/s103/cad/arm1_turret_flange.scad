// arm1_turret_flange: moving flange of joint 1
// Link: arm1.  Material: machined_aluminium.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() turned([[70, turret_bot], [81, turret_bot], [82, turret_bot + 1], [82, turret_bot + 14],
                  [80.5, turret_bot + 16], [50, turret_bot + 16]], n = 42);
