// base_flange: fixed flange of joint 1
// Link: base.  Material: machined_aluminium.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() turned([[80, ped_top - 6], [flange_r - 6, ped_top - 2], [flange_r, ped_top + 3],
                  [flange_r, base_top - 2], [flange_r - 2, base_top], [20, base_top]], n = 48);
