// arm1_j2_ring: bearing ring of joint 2
// Link: arm1.  Material: machined_aluminium.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() translate([L1, 0, 0]) turned([[55, arm1_top - 3], [55, arm1_top + 4], [52, arm1_top + 6], [52, arm1_top + 11],
    [54, arm1_top + 12.5], [54, j2_gap_z - 1], [53, j2_gap_z], [10, j2_gap_z]], n = 36);
