// base_connector_panel: plate of the connectors
// Link: base.  Material: machined_aluminium.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() translate([panel_x + 6, 0, 106]) rotate([0, -90, 0]) soft_box(-58, 58, 54, 6, 0, 6, 0, 1.5, n = 3, k = 1);
