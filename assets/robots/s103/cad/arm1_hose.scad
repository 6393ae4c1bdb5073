// arm1_hose: corrugated conduit from the junction box to the swivel over joint 2
// Link: arm1.  Material: rubber.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() loft(rings_hose([[-92, box_top + 14], [-104, 1000], [L1, 1020], [L1, swivel_top + 18]],
                          hose_r, 41, 2.3, n = 12));
