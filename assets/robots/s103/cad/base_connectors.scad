// base_connectors: rims of two round connectors, a switch, a D-type shell
// Link: base.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() translate([panel_x, 0, 106]) rotate([0, -90, 0]) lofts(concat(
    [for (y = [-26, 26]) [for (q = [[19, -1], [19, 4], [14, 4.01], [14, 14]]) ring_circle(q[0], q[1], 18, [22, y])]],
    [rings_cylinder(8, -1, 6, 0, 1, n = 16, k = 1, c = [-30, -34]),
     [for (l = soft(-1, 7, 0, 1, 1)) ring_rect(-36 + l[1], -24 - l[1], 20 - l[1], 3, l[0], n = 3)]]));
