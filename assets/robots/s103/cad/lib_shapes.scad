// Shapes the parts of the robot are drawn with.
// Drawn for this project; licence BSD-3-Clause.
//
// Most parts are lofts: rings of equally many points, one above the other,
// anticlockwise as seen from the last ring.  A loft is one polyhedron, hence
// quick to export, closed, and its fillets are true.

// one polyhedron of one or several separate lofts
module lofts(list) {
    function start(i) = i == 0 ? 0 : start(i - 1) + len(list[i - 1]) * len(list[i - 1][0]);
    polyhedron(
        points = [for (rings = list, r = rings) each r],
        faces = [for (q = [0 : len(list) - 1])
                     let (o = start(q), m = len(list[q]), n = len(list[q][0]))
                     each concat(
                         [[for (j = [0 : n - 1]) o + j]],
                         [for (i = [0 : m - 2], j = [0 : n - 1])
                              let (a = o + i * n + j, b = o + i * n + (j + 1) % n)
                              each [[a, a + n, b + n], [a, b + n, b]]],
                         [[for (j = [0 : n - 1]) o + m * n - 1 - j]])],
        convexity = 8);
}
module loft(rings) { lofts([rings]); }

// --- rings ----------------------------------------------------------------
function ring_circle(r, z, n = 40, c = [0, 0]) =
    [for (i = [0 : n - 1]) [c[0] + r * cos(360 * i / n), c[1] + r * sin(360 * i / n), z]];

// outline round two circles on the x axis (x1 < x2)
function ring_capsule(x1, r1, x2, r2, z, n = 20) =
    let (p = acos((r1 - r2) / (x2 - x1)))
    concat([for (i = [0 : n]) let (a = -p + 2 * p * i / n) [x2 + r2 * cos(a), r2 * sin(a), z]],
           [for (i = [0 : n]) let (a = p + (360 - 2 * p) * i / n) [x1 + r1 * cos(a), r1 * sin(a), z]]);

// rounded rectangle x0..x1, -y..y (n steps a corner)
function ring_rect(x0, x1, y, r, z, n = 6) =
    [for (c = [[x1 - r, y - r, 0], [x0 + r, y - r, 90], [x0 + r, r - y, 180], [x1 - r, r - y, 270]],
          i = [0 : n])
        [c[0] + r * cos(c[2] + 90 * i / n), c[1] + r * sin(c[2] + 90 * i / n), z]];

// [height, inset] of a solid z0..z1 with a fillet fb below and ft above
function soft(z0, z1, fb, ft, k = 4) =
    concat(fb > 0 ? [for (i = [0 : k]) [z0 + fb * (1 - cos(90 * i / k)), fb * (1 - sin(90 * i / k))]]
                  : [[z0, 0]],
           ft > 0 ? [for (i = [k : -1 : 0]) [z1 - ft * (1 - cos(90 * i / k)), ft * (1 - sin(90 * i / k))]]
                  : [[z1, 0]]);

// --- solids ---------------------------------------------------------------
function rings_cylinder(r, z0, z1, fb = 1, ft = 1, n = 40, k = 3, c = [0, 0]) =
    [for (l = soft(z0, z1, fb, ft, k)) ring_circle(r - l[1], l[0], n, c)];
module soft_cylinder(r, z0, z1, fb = 1, ft = 1, n = 40, k = 3, c = [0, 0])
    loft(rings_cylinder(r, z0, z1, fb, ft, n, k, c));
module soft_capsule(x1, r1, x2, r2, z0, z1, fb, ft, n = 20, k = 4)
    loft([for (l = soft(z0, z1, fb, ft, k)) ring_capsule(x1, r1 - l[1], x2, r2 - l[1], l[0], n)]);
module soft_box(x0, x1, y, r, z0, z1, fb, ft, n = 6, k = 4)
    loft([for (l = soft(z0, z1, fb, ft, k))
              ring_rect(x0 + l[1], x1 - l[1], y - l[1], r - l[1], l[0], n)]);
// turned solid of [radius, height] pairs, from the bottom to the top
module turned(p, n = 40) loft([for (q = p) ring_circle(q[0], q[1], n)]);
// socket-head bolt standing at c, underside of the head at z0
function bolt_socket(c, z0, r = 5, h = 5.5, n = 12) =
    [ring_circle(r, z0, n, c),
     ring_circle(r, z0 + h - r * 0.15, n, c),
     ring_circle(r * 0.85, z0 + h, n, c),
     ring_circle(r * 0.52, z0 + h, n, c),
     ring_circle(r * 0.52, z0 + h * 0.45, n, c)];
// hexagon-head bolt
function bolt(c, z0, r = 5, h = 5.5) =
    [ring_circle(r, z0, 6, c), ring_circle(r, z0 + h - r * 0.2, 6, c), ring_circle(r * 0.82, z0 + h, 6, c)];
module bolts(at, z0, r = 5, h = 5.5) lofts([for (c = at) bolt(c, z0, r, h)]);
function circle_of(n, r, c = [0, 0], a0 = 0) =
    [for (i = [0 : n - 1]) [c[0] + r * cos(a0 + 360 * i / n), c[1] + r * sin(a0 + 360 * i / n)]];

// --- hoses: a circle along a cubic curve in a plane of constant y ---------
function bez(p, t) = let (s = 1 - t)
    s*s*s * p[0] + 3*s*s*t * p[1] + 3*s*t*t * p[2] + t*t*t * p[3];
function bez_d(p, t) = let (s = 1 - t)
    s*s * (p[1] - p[0]) + 2*s*t * (p[2] - p[1]) + t*t * (p[3] - p[2]);
function ring_along(p, t, r, n, y) =
    let (q = bez(p, t), d = bez_d(p, t), v = d / norm(d))
    [for (j = [0 : n - 1]) let (a = 360 * j / n)
        [q[0] + r * cos(a) * v[1], y + r * sin(a), q[1] - r * cos(a) * v[0]]];
// [length along the curve, parameter] pairs, to space the rings evenly
function bez_table(p, k = 64) =
    [for (i = 0, s = 0; i <= k; i = i + 1, s = s + norm(bez(p, i / k) - bez(p, (i - 1) / k))) [s, i / k]];
// p: four [x, z]; m even rings, or m ribs of depth g
function rings_hose(p, r, m, g = 0, n = 14, y = 0) =
    let (t = bez_table(p), l = t[64][0], k = g == 0 ? m : 2 * m)
    [for (i = [0 : k]) ring_along(p, i == k ? 1 : lookup(l * i / k, t), i % 2 == 0 ? r : r - g, n, y)];

// --- lettering: strokes on a grid 4 wide, 6 high (no font is needed) --------
function strokes(ch) =
    ch == "U" ? [[[0,6],[0,1.2],[1.2,0],[2.8,0],[4,1.2],[4,6]]] :
    ch == "N" ? [[[0,0],[0,6],[4,0],[4,6]]] :
    ch == "I" ? [[[2,0],[2,6]]] :
    ch == "M" ? [[[0,0],[0,6],[2,2.6],[4,6],[4,0]]] :
    ch == "A" ? [[[0,0],[2,6],[4,0]], [[0.7,2],[3.3,2]]] :
    ch == "T" ? [[[0,6],[4,6]], [[2,6],[2,0]]] :
    ch == "E" ? [[[4,6],[0,6],[0,0],[4,0]], [[0,3],[3.2,3]]] :
    ch == "S" ? [[[4,5.2],[3.2,6],[0.8,6],[0,5.2],[0,3.8],[0.8,3],[3.2,3],[4,2.2],[4,0.8],[3.2,0],[0.8,0],[0,0.8]]] :
    ch == "1" ? [[[0.8,4.8],[2,6],[2,0]], [[0.8,0],[3.2,0]]] :
    ch == "0" ? [[[0,1.2],[1.2,0],[2.8,0],[4,1.2],[4,4.8],[2.8,6],[1.2,6],[0,4.8],[0,1.2]]] :
    ch == "3" ? [[[0,5.2],[0.8,6],[3.2,6],[4,5.2],[4,3.8],[3.2,3],[1.6,3]], [[3.2,3],[4,2.2],[4,0.8],[3.2,0],[0.8,0],[0,0.8]]] :
    ch == "-" ? [[[0.6,3],[3.4,3]]] : [];
// centred text, h high, w thick strokes (2-D)
module lettering(txt, h, w) {
    s = h / 6;
    step = 5.9;
    translate([-(len(txt) * step - step + 4) * s / 2, -h / 2])
        for (i = [0 : len(txt) - 1], l = strokes(txt[i]), k = [0 : len(l) - 2])
            hull() for (q = [l[k], l[k + 1]])
                translate([(i * step + q[0]) * s, q[1] * s]) circle(d = w, $fn = 6);
}
// children (drawn in x, y, thickness along z) onto the flank of a capsule
// outline, at the height z and the distance x along it; side +1 is +y
module on_flank(x1, r1, x2, r2, x, z, side) {
    b = asin((r1 - r2) / (x2 - x1));
    y = r1 / cos(b) - (x - x1) * tan(b);
    translate([x, side * y, z]) rotate([0, 0, -side * b])
        rotate([90, 0, side > 0 ? 180 : 0]) children();
}
