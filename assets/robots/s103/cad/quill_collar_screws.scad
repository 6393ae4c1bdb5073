// quill_collar_screws: screws of the guide
// Link: quill.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_quill() translate([0, 0, collar_bot + 10]) rotate([0, 90, 0]) {
    bolts([[0, 0]], 21, 3.4, 4);
    rotate([0, 180, 0]) bolts([[0, 0]], 21, 3.4, 4);
}
