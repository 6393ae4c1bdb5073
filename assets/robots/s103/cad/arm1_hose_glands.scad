// arm1_hose_glands: glands at both ends of the conduit
// Link: arm1.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

function gland(c, z) = [for (p = [[17, 0], [17, 3], [15, 3.5], [15, 10], [17, 10.5], [17, 21], [15.5, 22.5]])
                            ring_circle(p[0], z + p[1], 18, c)];
in_arm1() lofts([gland([-92, 0], box_top - 1), gland([L1, 0], swivel_top + 2)]);
