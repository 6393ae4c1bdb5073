// arm1_box_ribs: cooling ribs of the lid
// Link: arm1.  Material: graphite_casting.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() translate([box_x[0] + 1, 0, 457]) rotate([0, -90, 0]) lofts([for (x = [-48 : 12 : 48])
    [for (l = soft(3, 8.5, 0, 1.2, 1)) ring_rect(x - 2.5 + l[1], x + 2.5 - l[1], 24 - l[1], 2.4 - l[1], l[0], n = 2)]]);
