// arm1_junction_box: junction box behind the turret, where the hose begins
// Link: arm1.  Material: painted_casting.
include <dimensions.scad>
use <lib_shapes.scad>

in_arm1() soft_box(box_x[0], box_x[1], 46, 14, 366, box_top, 9, 9, n = 5, k = 3);
