// quill_bellows: bellows between the spline nut and the spindle's collar
// Link: quill.  Material: rubber.
include <dimensions.scad>
use <lib_shapes.scad>

n = 7;
p = (nut_bot - 1 - bellows_bot - 8) / n;
in_quill() turned(concat([[24, bellows_bot], [24, bellows_bot + 4]],
    [for (i = [0 : n - 1]) each [[19.5, bellows_bot + 4 + p * i + 0.01], [27, bellows_bot + 4 + p * (i + 0.5)]]],
    [[19.5, nut_bot - 5.1], [25, nut_bot - 5], [25, nut_bot - 1]]), n = 24);
