// base_name_plate_text: lettering of the name plate
// Link: base.  Material: dark_plastic.
include <dimensions.scad>
use <lib_shapes.scad>

in_base() translate([84, 0, 98]) rotate([90, 0, 90]) translate([0, 0, 4.2]) linear_extrude(0.9) {
    translate([0, 9]) lettering("UNIMATE", 12, 2.4);
    translate([0, -12]) lettering("S-103", 13, 2.4);
    translate([-32, -1.3]) square([64, 1.1]);
}
