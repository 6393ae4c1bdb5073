// base_name_plate_rivets: rivets of the name plate
// Link: base.  Material: machined_aluminium.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() translate([84, 0, 98]) rotate([90, 0, 90]) lofts([for (x = [-38.5, 38.5], y = [-20.5, 20.5])
    rings_cylinder(2.2, 3, 5.6, 0, 0.8, n = 8, k = 1, c = [x, y])]);
