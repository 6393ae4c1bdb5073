// base_flange_bolts: bolt circle of the fixed flange
// Link: base.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() bolts(circle_of(12, flange_r - 7.5, a0 = 15), base_top - 0.3, 4.2, 4.5);
