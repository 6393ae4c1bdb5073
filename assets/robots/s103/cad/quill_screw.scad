// quill_screw: upper length of the spindle: ball screw
// Link: quill.  Material: polished_steel.
include <dimensions.scad>
use <lib_shapes.scad>

// two starts of pitch 60 mm; the corners of the section follow the grooves
half = [[-13, quill_r], [-8, quill_r - 2.4], [8, quill_r - 2.4], [13, quill_r], [40, quill_r], [66.7, quill_r],
        [93.3, quill_r], [120, quill_r], [143.5, quill_r]];
function ring(z, w) = [for (s = [0, 180], q = half) [q[1] * cos(q[0] + s + w), q[1] * sin(q[0] + s + w), z]];
z0 = arm2_top; z1 = quill_top - 12; m = 44;
// (drawn left-handed and mirrored: so the loft's diagonals run along the groove)
in_quill() mirror([0, 1, 0]) loft([for (i = [0 : m]) let (z = z0 + (z1 - z0) * i / m) ring(z, -360 * (z - z0) / 60)]);
