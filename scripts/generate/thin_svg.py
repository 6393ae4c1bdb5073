#!/usr/bin/env python3
"""Makes SVG drawings of gnuplot and graphviz smaller, without a visible change.

    python3 scripts/generate/thin_svg.py FILE.svg...

Curves keep the points that Douglas and Peucker's algorithm needs for an error of at most TOLERANCE pixels.
Coordinates get one decimal, in path data relative to the previous point. A series of dots becomes one path. Empty
groups, unused definitions and space between elements are removed.
"""
import itertools
import pathlib
import re
import sys

TOLERANCE = 0.2  # [pixels]
NUMBER = re.compile(r"-?\d+\.\d+")
PAIR = r"-?(?:\d+\.?\d*|\.\d+)[\s,]*-?(?:\d+\.?\d*|\.\d+)"
MARKERS = re.compile(r"(?:<use xlink:href='#(\w+)' transform='translate\([^)]*\) scale\(([\d.]+)\)' "
                     r"color='([^']*)'/>\s*)"
                     r"(?:<use xlink:href='#\1' transform='translate\([^)]*\) scale\(\2\)' color='\3'/>\s*)*")


def thinned(points, tolerance=TOLERANCE):
    """The points of a polyline that are needed, without recursion."""
    keep, ranges = {0, len(points) - 1}, [(0, len(points) - 1)]
    while ranges:
        first, last = ranges.pop()
        (x0, y0), (x1, y1) = points[first], points[last]
        dx, dy = x1 - x0, y1 - y0
        length2 = dx * dx + dy * dy
        worst, at = tolerance ** 2, None
        for i in range(first + 1, last):
            x, y = points[i][0] - x0, points[i][1] - y0
            t = min(1, max(0, (x * dx + y * dy) / length2)) if length2 else 0
            distance2 = (x - t * dx) ** 2 + (y - t * dy) ** 2
            if distance2 > worst:
                worst, at = distance2, i
        if at is not None:
            keep.add(at)
            ranges += [(first, at), (at, last)]
    return [points[i] for i in sorted(keep)]


def pair(text):
    return tuple(map(float, re.findall(r"-?(?:\d+\.?\d*|\.\d+)", text)))


def polylines(data):
    """[points, whether closed] of path data that has moves and lines only; None if it has others."""
    if not re.fullmatch(r"[MLZmlz\d\s.,-]*", data):
        return None
    lines, x, y, command = [], 0.0, 0.0, "M"
    for token in re.findall(rf"[MLZmlz]|{PAIR}", data):
        if token in "Zz":
            lines[-1][1] = True
            x, y = lines[-1][0][0]
        elif token in "MLml":
            command = token
        else:
            a, b = pair(token)
            x, y = (a, b) if command in "ML" else (x + a, y + b)
            if command in "Mm":
                lines.append([[], False])
                command = "L" if command == "M" else "l"
            lines[-1][0].append((x, y))
    return lines


def in_tenths(value):
    """An integer number of tenths as text: 1.5, -.3, 20."""
    sign, value = "-" if value < 0 else "", abs(value)
    whole, tenth = divmod(value, 10)
    return sign + (str(whole) if whole or not tenth else "") + (f".{tenth}" if tenth else "")


def rounded(text):
    return in_tenths(round(10 * float(text)))


def joined(*values):
    """Numbers of path data: a minus sign separates too."""
    text = ""
    for value in map(in_tenths, values):
        text += ("" if not text or value.startswith("-") else " ") + value
    return text


def path_data(data):
    lines = polylines(data)
    if lines is None:
        return curve_data(data)
    text, x, y = "", 0, 0
    for points, closed in lines:
        for n, (a, b) in enumerate(thinned(points)):
            a, b = round(10 * a), round(10 * b)
            if n == 0:
                text += ("m" if text else "M") + joined(a - x, b - y)
            elif n == 1 or (a, b) != (x, y):
                step = joined(a - x, b - y)
                text += ("l" if n == 1 else "" if step.startswith("-") else " ") + step
            x, y = a, b
        if closed:
            text += "z"
            x, y = (round(10 * value) for value in points[0])
    return text


def curve_data(data):
    """Of a start and Bezier curves, as graphviz draws edges; other data are only rounded."""
    if not re.fullmatch(r"M[\d\s.,-]*C[\d\s.,-]*", data):
        return NUMBER.sub(lambda m: rounded(m[0]), data)
    points = [tuple(round(10 * value) for value in pair(text)) for text in re.findall(PAIR, data)]
    text = f"M{joined(*points[0])}"
    for n in range(1, len(points) - 2, 3):
        x, y = points[n - 1]
        text += "c" + joined(*(value for a, b in points[n:n + 3] for value in (a - x, b - y)))
    return text


def as_dots(match):
    """A series of gnuplot's filled circles as one path: a line of no length with round ends is a dot.

    gnuplot's circle of radius 1 has a rim of 0.205 around it."""
    if not match[1].endswith("gpPt6"):
        return match[0]
    places = [tuple(round(10 * float(value)) for value in place)
              for place in re.findall(r"translate\(([-\d.]+),([-\d.]+)\)", match[0])]
    text, x, y = "", 0, 0
    for a, b in dict.fromkeys(places):
        text += ("m" if text else "M") + joined(a - x, b - y) + "h0"
        x, y = a, b
    return (f"<path stroke='{match[3]}' stroke-width='{2.205 * float(match[2]):.3g}' stroke-linecap='round' "
            f"stroke-dasharray='none' d='{text}'/>")


def thin(svg):
    head, defs, body = re.fullmatch(r"(.*?)(<defs>.*?</defs>|)((?:(?!<defs>).)*)", svg, re.S).groups() \
        if svg.count("<defs>") == 1 else (svg[:0], "", svg)
    body = re.sub(r"<!--.*?-->|<!DOCTYPE[^>]*>", "", body, flags=re.S)
    body = re.sub(r"(<path\b[^>]*?\sd=)(['\"])(.*?)\2",
                  lambda m: f"{m[1]}{m[2]}{path_data(m[3])}{m[2]}", body, flags=re.S)
    body = re.sub(r'(\bpoints=)(["\'])(.*?)\2',
                  lambda m: m[1] + m[2] + NUMBER.sub(lambda n: rounded(n[0]), m[3]).strip() + m[2], body, flags=re.S)
    body = MARKERS.sub(as_dots, body)
    body = re.sub(r"translate\(([-\d.]+),([-\d.]+)\)", lambda m: f"translate({rounded(m[1])},{rounded(m[2])})", body)
    if not re.search(r"stroke-line(cap|join)=\"round", body):  # else these are the defaults of SVG
        body = re.sub(r' stroke-linecap="butt"| stroke-linejoin="miter"', "", body)
    body = re.sub(r"<(g|tspan)\b[^>]*>\s*</\1>", "", body)
    body = re.sub(r"(<text\b[^>]*>)<tspan font-family=\"[^\"]*\"\s*>([^<]*)</tspan></text>", r"\1\2</text>", body)
    used = set(re.findall(r"#([\w-]+)", body))
    while True:  # what a used definition uses is used
        kept = [d for d in re.findall(r"<(?:filter\b.*?</filter>|clipPath\b.*?</clipPath>|[^>]*/>)", defs, re.S)
                if re.search(r"id=['\"]([^'\"]+)", d)[1] in used]
        more = used | set(re.findall(r"#([\w-]+)", " ".join(kept)))
        if more == used:
            break
        used = more
    head = re.sub(r"<desc>.*?</desc>", "", head)
    svg = head + ("<defs>" + "\n".join(kept) + "</defs>" if kept else "") + body
    svg = re.sub(r"\s+(?=[\w:-]+=['\"])", " ", svg)
    svg = re.sub(r"(['\"])\s*(/?>)", r"\1\2", svg)
    return re.sub(r">\s+<", ">\n<", svg).strip() + "\n"


CELL = 2  # [pixels]


def cells(data):
    """The squares of CELL pixels that path data pass."""
    found = set()
    for points, closed in polylines(data) or []:
        for (x, y), (u, v) in zip(points, points[1:] + points[:1] if closed else points[1:] + points[-1:]):
            steps = int(max(abs(u - x), abs(v - y)) / CELL) + 1
            found.update((round((x + (u - x) * k / steps) / CELL), round((y + (v - y) * k / steps) / CELL))
                         for k in range(steps + 1))
    return found


def difference(old, new):
    """What differs visibly between two drawings of gnuplot: a text, or a curve by more than two squares; else None."""
    texts = [re.findall(r"<text\b[^>]*>(.*?)</text>", svg, re.S) for svg in (old, new)]
    for a, b in itertools.zip_longest(*texts, fillvalue=""):
        if a != b:
            return f"text '{a.strip()}' is now '{b.strip()}'"
    paths = [re.findall(r"<path\b[^>]*?\sd=['\"]([^'\"]*)", svg) for svg in (old, new)]
    if len(paths[0]) != len(paths[1]):
        return f"{len(paths[0])} paths are now {len(paths[1])}"
    reach = [(x, y) for x in (-2, -1, 0, 1, 2) for y in (-2, -1, 0, 1, 2)]
    for number, (a, b) in enumerate(zip(*paths)):
        one, other = (cells(data.replace("h0", "")) for data in (a, b))  # dots as single points
        for x, y in (one - other) | (other - one):
            if not all(any((x + u, y + v) in squares for u, v in reach) for squares in (one, other)):
                return f"path {number} is elsewhere at {CELL * x}, {CELL * y}"
    return None


def main():
    for name in sys.argv[1:]:
        file = pathlib.Path(name)
        text = file.read_text(encoding="utf-8")
        file.write_text(thin(text), encoding="utf-8")
        print(f"{name}: {len(text.encode())} -> {file.stat().st_size} bytes")


if __name__ == "__main__":
    main()
