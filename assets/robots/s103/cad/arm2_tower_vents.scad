// arm2_tower_vents: ventilation louvres of the tower
// Link: arm2.  Material: dark_plastic.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() lofts([for (i = [0 : 5]) let (z = 762 + 13 * i, y = tower_y - 5 * (z - arm2_top) / 150 + 1.2)
    [for (l = soft(z, z + 6, 1, 1, 1)) ring_rect(192 + l[1], 264 - l[1], y - l[1] / 2, 4, l[0], n = 1)]]);
