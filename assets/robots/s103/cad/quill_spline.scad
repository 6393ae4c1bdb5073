// quill_spline: lower length of the spindle: ball spline
// Link: quill.  Material: polished_steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_quill() translate([0, 0, collar_bot + 2]) linear_extrude(arm2_top - collar_bot) difference() {
    circle(quill_r, $fn = 36);
    for (a = [0 : 60 : 300]) rotate(a) translate([quill_r + 0.6, 0]) circle(2.8, $fn = 8);
}
