// quill_top_stop: stop ring at the upper end
// Link: quill.  Material: machined_aluminium.
include <dimensions.scad>
use <lib_shapes.scad>

in_quill() turned([[20, quill_top - 16], [22, quill_top - 15], [22, quill_top - 4], [20, quill_top - 2],
                   [12, quill_top - 1.5], [11, quill_top + 3], [9, quill_top + 4]], n = 32);
