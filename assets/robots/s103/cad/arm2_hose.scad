// arm2_hose: hose from the swivel to the motor tower
// Link: arm2.  Material: rubber.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm2() loft(rings_hose([[30, 783], [100, 783], [92, 838], [tower_x[0] - 4, 838]], 8, 16, 1.5, n = 8));
