// arm1_box_screws: screws of the lid
// Link: arm1.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() translate([box_x[0] + 1, 0, 457]) rotate([0, -90, 0])
    bolts([for (x = [-71, 71], y = [-27, 27]) [x, y]], 4.7, 3.6, 3.2);
