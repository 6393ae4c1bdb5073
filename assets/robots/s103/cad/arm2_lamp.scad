// arm2_lamp: signal lamp on the tower
// Link: arm2.  Material: amber_glass.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() translate([tower_x[0] + 44, 0, 0]) turned([[11, tower_top + 3], [11, tower_top + 16], [10, tower_top + 20],
    [7, tower_top + 23.5], [3, tower_top + 25], [1, tower_top + 25.2]], n = 20);
