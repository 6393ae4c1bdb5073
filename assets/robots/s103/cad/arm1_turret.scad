// arm1_turret: turret column
// Link: arm1.  Material: painted_casting.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() turned([[turret_r + 2.5, turret_bot + 15], [turret_r + 0.8, turret_bot + 18], [turret_r, turret_bot + 24],
    [turret_r - 2, 330], [turret_r - 2.5, 380], [turret_r - 1.5, 430], [turret_r + 1, 450],
    [turret_r + 4, 463], [turret_r + 7, arm1_bot + 3], [turret_r + 7, arm1_bot + 10]], n = 42);
