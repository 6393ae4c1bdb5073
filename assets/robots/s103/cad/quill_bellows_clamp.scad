// quill_bellows_clamp: hose clip at the lower end of the bellows
// Link: quill.  Material: polished_steel.
include <dimensions.scad>
use <lib_shapes.scad>

in_quill() turned([[20, bellows_bot - 4], [25.2, bellows_bot - 3], [25.8, bellows_bot - 2], [25.8, bellows_bot + 2.5], [25.2, bellows_bot + 3.5], [20, bellows_bot + 3.6]], n = 24);
