// base_gussets: four ribs between the foot plate and the pedestal
// Link: base.  Material: graphite_casting.
include <dimensions.scad>
use <lib_shapes.scad>

module rib() rotate([90, 0, 90]) linear_extrude(12, center = true)
    polygon(concat([[80, plate_h - 1], [plate_y - 8, plate_h - 1], [plate_y - 8, plate_h + 8]],
        [for (a = [0 : 15 : 90]) [plate_y - 9 - 17 * sin(a), 118 - 90 * cos(a)]], [[80, 118]]));
in_base() for (x = [-38, 38], s = [0, 1]) mirror([0, s, 0]) translate([x, 0, 0]) rib();
