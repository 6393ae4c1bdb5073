// base_name_plate: name plate on the front of the pedestal
// Link: base.  Material: orange_enamel.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() translate([84, 0, 98]) rotate([90, 0, 90]) soft_box(-44, 44, 26, 5, -4, 4.4, 0, 0.8, n = 3, k = 1);
