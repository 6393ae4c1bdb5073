// base_connector_box: box of the connectors, at the back
// Link: base.  Material: graphite_casting.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() soft_box(panel_x + 4, -70, 58, 6, 44, 168, 3, 5, n = 3, k = 2);
