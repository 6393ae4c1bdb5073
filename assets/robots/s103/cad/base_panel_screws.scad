// base_panel_screws: screws of the connector panel
// Link: base.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() translate([panel_x, 0, 106]) rotate([0, -90, 0])
    bolts([for (x = [-50, 50], y = [-46, 46]) [x, y]], -0.3, 3.4, 3);
