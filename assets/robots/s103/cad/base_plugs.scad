// base_plugs: plugs of the two cables
// Link: base.  Material: dark_plastic.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() translate([panel_x - 12, 0, 106]) rotate([0, -90, 0]) lofts([for (y = [-26, 26])
    rings_cylinder(12.5, 0, 18, 0, 2, n = 16, k = 1, c = [22, y])]);
