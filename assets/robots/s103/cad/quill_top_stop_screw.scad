// quill_top_stop_screw: clamp screw of the stop ring
// Link: quill.  Material: steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_quill() translate([21, 0, quill_top - 9.5]) rotate([0, 90, 0]) bolts([[0, 0]], 0, 3, 4);
