// base_cables: two cables from the plugs down to the floor
// Link: base.  Material: rubber.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() lofts([for (y = [-26, 26])
    rings_hose([[panel_x - 24, 128], [panel_x - 74, 128], [panel_x - 60, 60], [panel_x - 60, 0]],
               7.5, 12, n = 10, y = y)]);
