// base_pedestal: pedestal, square at the foot and round at joint 1
// Link: base.  Material: graphite_casting.
include <dimensions.scad>
use <lib_shapes.scad>

// [height, half width, corner radius]
shape = [[plate_h - 2, 95, 30], [plate_h + 3, 92, 31], [plate_h + 10, 89.5, 32], [plate_h + 22, 88, 33],
         [90, 86, 36], [150, 84, 44], [182, 83, 58], [204, 82.5, 76], [216, 81.5, 81],
         [222, 79.5, 79], [ped_top, 76, 75.5]];
in_base() loft([for (s = shape) ring_rect(-s[1], s[1], s[1], s[2], s[0], n = 6)]);
