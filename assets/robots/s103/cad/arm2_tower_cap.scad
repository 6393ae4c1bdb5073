// arm2_tower_cap: top plate of the tower
// Link: arm2.  Material: orange_enamel.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() soft_box(tower_x[0] + 24, tower_x[1] - 24, tower_y - 20, 12, tower_top - 3, tower_top + 5, 0, 3, n = 4, k = 2);
